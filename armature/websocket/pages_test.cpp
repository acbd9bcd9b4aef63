// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/pages.hpp"

#include <gtest/gtest.h>

#include "armature/websocket/internal/test_site.hpp"

namespace armature::websocket::internal {
namespace {

class PagesTest : public ::testing::Test {
 protected:
  Site site_;
  const Pages pages_ = Pages::in(site_.folder()).value();
};

TEST_F(PagesTest, FilesHaveTheirTypesAndFoldersAnIndex) {
  EXPECT_EQ(pages_.find("/")->file, site_.folder() + "/index.html");
  EXPECT_EQ(pages_.find("/")->type, "text/html; charset=utf-8");
  EXPECT_EQ(pages_.find("/page.js")->type, "text/javascript; charset=utf-8");
  EXPECT_EQ(pages_.find("/more")->file, site_.folder() + "/more/index.html");
  EXPECT_EQ(pages_.find("/same.js")->file, site_.folder() + "/page.js");
}

TEST_F(PagesTest, NothingOutsideOfTheFolderIsFound) {
  for (const char* path : {"/../secret.txt", "/more/../../secret.txt", "/link.txt", "//secret.txt",
                           "/..", "secret.txt", "", "/more/..%2f..%2fsecret.txt", "/..\\secret.txt",
                           "/\x01page.js", "/page.js ", "/pages/index.html"}) {
    EXPECT_FALSE(pages_.find(path)) << path;
  }
  EXPECT_FALSE(pages_.find(std::string("/page.js\0.html", 14)));
}

TEST_F(PagesTest, WhatIsHiddenOrNoPageNeedsIsNotServed) {
  EXPECT_FALSE(pages_.find("/.hidden.html"));
  EXPECT_FALSE(pages_.find("/robot.key"));
  EXPECT_FALSE(pages_.find("/nothing.html"));
}

}  // namespace
}  // namespace armature::websocket::internal
