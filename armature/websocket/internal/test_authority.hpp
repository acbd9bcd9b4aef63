// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: authorities and the certificates that they sign, made by the program openssl.

#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "armature/websocket/transport.hpp"

namespace armature::websocket::internal {

/// A folder of files in PEM form that goes with the test.
class TestAuthorities {
 public:
  TestAuthorities()
      : folder_(std::filesystem::path(::testing::TempDir()) /
                ("web_" + std::to_string(std::random_device{}()))) {
    std::filesystem::create_directory(folder_);
    make("authority");
  }
  TestAuthorities(const TestAuthorities&) = delete;
  TestAuthorities& operator=(const TestAuthorities&) = delete;
  ~TestAuthorities() { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void make(const std::string& authority) const {
    run("req -x509 " + kKey + " -keyout " + path(authority + ".key") + " -out " +
        path(authority + ".pem") + " -days 2 -subj /CN=" + authority +
        " -addext keyUsage=critical,keyCertSign");
  }

  /// A certificate for 127.0.0.1, ::1 and localhost, and whom it trusts.
  Options issue(const std::string& common_name, const std::string& authority = "authority") const {
    const std::string own = path(common_name);
    run("req " + kKey + " -keyout " + own + ".key -out " + own + ".csr -subj /CN=" + common_name +
        " -addext subjectAltName=DNS:localhost,IP:127.0.0.1,IP:0:0:0:0:0:0:0:1");
    run("x509 -req -in " + own + ".csr -CA " + path(authority + ".pem") + " -CAkey " +
        path(authority + ".key") + " -CAcreateserial -days 2 -copy_extensions copy -out " + own +
        ".pem");
    Options options;
    options.certificate = own + ".pem";
    options.key = own + ".key";
    options.authority = path("authority.pem");
    return options;
  }

 private:
  static void run(const std::string& command) {
    ASSERT_EQ(std::system(("openssl " + command + " 2>/dev/null").c_str()), 0) << command;
  }

  const std::string kKey = "-newkey ec -pkeyopt ec_paramgen_curve:P-256 -noenc";
  const std::filesystem::path folder_;
};

}  // namespace armature::websocket::internal
