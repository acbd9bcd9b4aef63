// SPDX-License-Identifier: Apache-2.0
// What is wrong with the files is said before anything listens.
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/tls/internal/certificate.hpp"
#include "armature/tls/internal/test_certificates.hpp"
#include "armature/tls/transport.hpp"

namespace armature::tls {
namespace {

using internal::Folder;
using internal::issue;
using internal::Issued;
using ::testing::HasSubstr;

class Credentials : public testing::Test {
 protected:
  /// What is said of the files; a transport is made only if there is no error.
  std::string findings() const {
    base::Diagnostics diagnostics;
    const auto made = make_transport(options_, diagnostics);
    EXPECT_EQ(made != nullptr, diagnostics.ok());
    return diagnostics.to_text();
  }
  void issue_own(const internal::Wish& wish) {
    options_ = folder_.write("robot", issue(wish, &authority_), authority_);
  }
  std::string text_file(const std::string& name, const std::string& content) const {
    std::ofstream(folder_.path(name)) << content;
    return folder_.path(name);
  }

  Folder folder_;
  Issued authority_ = internal::make_authority();
  Options options_ = folder_.write("robot", issue({}, &authority_), authority_);
};

TEST_F(Credentials, NothingIsSaidOfGoodOnes) { EXPECT_EQ(findings(), ""); }

TEST_F(Credentials, AllMistakesAreToldInOneRun) {
  options_ = {"/no/such/robot.pem", text_file("empty.key", ""), ""};
  const std::string text = findings();
  EXPECT_THAT(text, HasSubstr("/no/such/robot.pem: error: the certificate cannot be read"));
  EXPECT_THAT(text, HasSubstr("empty.key: error: the key is not in PEM form"));
  EXPECT_THAT(text, HasSubstr("error: no file is given for the authority"));
}

TEST_F(Credentials, WhatIsNotPemIsNamed) {
  options_.certificate = text_file("robot.der", std::string("\x30\x82\x01", 3));
  EXPECT_THAT(findings(),
              HasSubstr("robot.der: error: the certificate is not in PEM form: expected "
                        "-----BEGIN CERTIFICATE-----"));
}

TEST_F(Credentials, AKeyOfAnotherCertificateDoesNotFit) {
  options_.key = folder_.write("other.key", issue({}, &authority_).key.get());
  EXPECT_THAT(findings(), HasSubstr("other.key: error: the key does not fit the certificate " +
                                    options_.certificate));
}

TEST_F(Credentials, AKeyWithAPasswordIsRefusedAndNobodyAsked) {
  options_.key = folder_.write("closed.key", issue({}, &authority_).key.get(), "1234");
  EXPECT_THAT(findings(), HasSubstr("closed.key: error: the key has a password"));
}

TEST_F(Credentials, AKeyThatOthersMayReadIsWarnedOf) {
  std::filesystem::permissions(options_.key, std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  EXPECT_EQ(findings(),
            options_.key + ": warning: everyone on this machine may read the key (chmod 600)\n");
}

TEST_F(Credentials, AnExpiredCertificateSaysWhenItExpired) {
  issue_own({.from_s = -7200, .until_s = -3600});
  EXPECT_THAT(findings(), HasSubstr("robot.pem: error: the certificate 'robot' expired on 20"));
}

TEST_F(Credentials, ACertificateOfTheFutureAsksForTheClock) {
  issue_own({.from_s = 3600, .until_s = 7200});
  EXPECT_THAT(findings(), HasSubstr("(check this machine's clock)"));
}

TEST_F(Credentials, ACertificateHasToNameSomebody) {
  issue_own({.common_name = "", .names = "IP:127.0.0.1"});
  EXPECT_THAT(findings(),
              HasSubstr("robot.pem: error: the certificate has no usable common name or DNS name"));
  issue_own({.common_name = "the robot"});
  EXPECT_THAT(findings(),
              HasSubstr("robot.pem: error: the certificate has no usable common name or DNS name"));
}

TEST_F(Credentials, AnAuthorityHasToBeOne) {
  options_.authority = options_.certificate;
  EXPECT_THAT(findings(), HasSubstr("robot.pem: error: 'robot' is not an authority"));
}

TEST(Identity, IsTheCommonNameOrElseTheFirstDnsName) {
  const auto identity = [](const internal::Wish& wish) {
    return internal::identity_of(*issue(wish, nullptr).certificate);
  };
  EXPECT_EQ(identity({.common_name = "anna", .names = "DNS:a.example"}), "anna");
  EXPECT_EQ(identity({.common_name = "", .names = "IP:1.2.3.4,DNS:a.example,DNS:b.example"}),
            "a.example");
  EXPECT_EQ(identity({.common_name = "", .names = ""}), "");
  EXPECT_EQ(identity({.common_name = "anna\n"}), "");
  EXPECT_EQ(identity({.common_name = "grüße"}), "");
  EXPECT_EQ(identity({.common_name = std::string("anna\0x", 6)}), "");
}

TEST(Names, AreAddressesAndDnsNames) {
  const auto own = issue({.names = "IP:192.168.1.5,IP:::1,DNS:robot.example"}, nullptr);
  EXPECT_EQ(internal::names_of(*own.certificate), "192.168.1.5, 0:0:0:0:0:0:0:1, robot.example");
}

}  // namespace
}  // namespace armature::tls
