// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/child_process.hpp"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/file.hpp"

namespace armature::platform {
namespace {

using namespace std::chrono_literals;

ChildProcess shell(const std::string& script, const ChildOptions& options = {}) {
  auto started = ChildProcess::start({"/bin/sh", "-c", script}, options);
  EXPECT_TRUE(started) << started.error();
  return std::move(started.value());
}

int exit_code_of(ChildProcess& child) {
  while (!child.exit_code()) std::this_thread::sleep_for(1ms);
  return *child.exit_code();
}

/// All that it writes until it has written `size` bytes or ended its output.
std::string read_from(ChildProcess& child, std::size_t size = std::string::npos) {
  std::string text;
  while (text.size() < size) {
    const auto part = child.read();
    if (!part) break;
    text += *part;
    std::this_thread::sleep_for(1ms);
  }
  return text;
}

TEST(ChildProcess, TellsHowItEnded) {
  ChildProcess child = shell("exit 7");
  EXPECT_EQ(exit_code_of(child), 7);
  EXPECT_EQ(child.exit_code(), 7);
}

TEST(ChildProcess, TellsWhichSignalEndedIt) {
  ChildProcess child = shell("exec sleep 100");
  child.send(SIGTERM);
  EXPECT_EQ(exit_code_of(child), 128 + SIGTERM);
}

TEST(ChildProcess, TakesLinesAndAnswersThem) {
  ChildProcess child = shell("while read line; do echo \"<$line>\"; done", {.piped = true});
  EXPECT_TRUE(child.write("one\n"));
  EXPECT_EQ(read_from(child, 6), "<one>\n");
  EXPECT_EQ(child.read(), "");
  EXPECT_TRUE(child.write("two\n"));
  EXPECT_EQ(read_from(child, 6), "<two>\n");
}

TEST(ChildProcess, OneThatHasEndedTakesNothingAndTheWriterLives) {
  ChildProcess child = shell("exit 0", {.piped = true});
  EXPECT_EQ(read_from(child), "");
  exit_code_of(child);
  EXPECT_FALSE(child.write("one\n"));
}

TEST(ChildProcess, WritesToItsLog) {
  const std::string log = ::testing::TempDir() + "child_process_log";
  ChildProcess child = shell("echo out; echo err >&2", {.log = log});
  exit_code_of(child);
  EXPECT_EQ(read_file(log).value(), "out\nerr\n");
  std::filesystem::remove(log);
}

TEST(ChildProcess, GoesWithItsOwnerUnlessItIsLasting) {
  int id = 0;
  {
    const ChildProcess child = shell("exec sleep 100");
    id = child.id();
    EXPECT_TRUE(process_lives(id));
  }
  EXPECT_FALSE(process_lives(id));
  {
    const ChildProcess child = shell("exec sleep 100", {.lasting = true});
    id = child.id();
  }
  EXPECT_TRUE(process_lives(id));
  ::kill(id, SIGKILL);
}

TEST(ChildProcess, WhatIsNoProgramIsAnError) {
  const auto started = ChildProcess::start({"/nowhere/program"});
  ASSERT_FALSE(started);
  EXPECT_THAT(started.error(), ::testing::HasSubstr("cannot start '/nowhere/program'"));
}

}  // namespace
}  // namespace armature::platform
