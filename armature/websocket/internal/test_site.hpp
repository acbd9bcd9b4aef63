// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace armature::websocket::internal {

/// A folder of pages, and a secret beside it; gone with the test.
class Site {
 public:
  Site() {
    static int number = 0;
    root_ = std::filesystem::path(::testing::TempDir()) /
            ("site_" + std::to_string(std::random_device{}()) + "_" + std::to_string(number++));
    std::filesystem::create_directories(root_ / "pages/more");
    write("pages/index.html", "<p>first</p>");
    write("pages/page.js", "1;");
    write("pages/more/index.html", "<p>more</p>");
    write("pages/.hidden.html", "hidden");
    write("pages/robot.key", "key");
    write("secret.txt", "secret");
    std::filesystem::create_symlink(root_ / "secret.txt", root_ / "pages/link.txt");
    std::filesystem::create_symlink("page.js", root_ / "pages/same.js");
  }
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;
  ~Site() { std::filesystem::remove_all(root_); }

  std::string folder() const { return (root_ / "pages").string(); }
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(root_ / name) << content;
  }

 private:
  std::filesystem::path root_;
};

}  // namespace armature::websocket::internal
