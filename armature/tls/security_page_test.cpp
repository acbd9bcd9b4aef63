// SPDX-License-Identifier: Apache-2.0
// What docs/security.md shows, with the files that it speaks of.
#include <fstream>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "armature/base/diagnostic.hpp"
#include "armature/ride/node.hpp"
#include "armature/ride/policy.hpp"
#include "armature/tls/internal/test_certificates.hpp"
#include "armature/tls/transport.hpp"

namespace {

using namespace armature;
using tls::internal::issue;
using tls::internal::make_authority;

/// Nothing after a mistake in the files: all of them are told before anything listens.
std::unique_ptr<ride::Node> make_node(const std::string& folder, base::Diagnostics& diagnostics) {
  const auto policy = ride::Policy::load(folder + "/robot.policy", diagnostics);
  ride::NodeOptions options;
  options.transports.push_back(tls::make_transport(
      {folder + "/robot.pem", folder + "/robot.key", folder + "/authority.pem"}, diagnostics));
  options.allows = [policy](const ride::AccessQuestion& question) {
    return policy.allows(question);
  };
  if (!diagnostics.ok()) return nullptr;
  return std::make_unique<ride::Node>(options);
}

class SecurityPage : public testing::Test {
 protected:
  SecurityPage() {
    const auto authority = make_authority();
    files_.write("robot", issue({}, &authority), authority);
    operator_ = files_.write("operator", issue({.common_name = "operator"}, &authority), authority);
    files_.write("authority.pem", authority.certificate.get());
    std::ofstream(files_.path("robot.policy")) << "allow operator@tls read,command Vision\n";
  }

  tls::internal::Folder files_;
  tls::Options operator_;
  base::Diagnostics diagnostics_;
};

TEST_F(SecurityPage, WhoHasACertificateOfTheAuthorityIsLetIn) {
  const auto robot = make_node(files_.path(""), diagnostics_);
  ASSERT_NE(robot, nullptr) << diagnostics_.to_text();
  const auto address = robot->listen("tls://127.0.0.1:0");
  ASSERT_TRUE(address.ok()) << address.error();
  ride::NodeOptions options;
  options.transports.push_back(tls::internal::transport_of(operator_));
  ride::Node node(options);
  const auto there =
      node.connect(address.value().text()).wait_until_connected(std::chrono::seconds(20));
  EXPECT_TRUE(there.ok()) << there.error();
}

TEST_F(SecurityPage, MistakesInTheFilesAreToldBeforeAnythingListens) {
  std::ofstream(files_.path("robot.policy")) << "permit everyone\n";
  std::ofstream(files_.path("robot.key")) << "no key\n";
  EXPECT_EQ(make_node(files_.path(""), diagnostics_), nullptr);
  EXPECT_NE(diagnostics_.to_text().find("robot.policy:1"), std::string::npos);
  EXPECT_NE(diagnostics_.to_text().find("robot.key"), std::string::npos);
}

}  // namespace
