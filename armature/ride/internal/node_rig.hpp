// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: a node with a camera, and clients that say what they are told to.

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/ride/internal/raw_client.hpp"
#include "armature/ride/internal/test_bytes.hpp"
#include "armature/ride/internal/test_vision.hpp"
#include "armature/ride/node.hpp"

namespace armature::ride {

/// Its command `start` waits until it is let go.
class Camera : public VisionService {
 public:
  void start() override {
    std::unique_lock lock(mutex_);
    started_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return go_; });
  }
  void note(std::int32_t what) override {
    const std::lock_guard lock(mutex_);
    notes_.push_back(what);
    changed_.notify_all();
  }
  void later(PendingReply reply) override { kept.push_back(std::move(reply)); }
  std::int32_t initialize() override { throw Failure("no lens"); }

  void wait_until_started() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return started_; });
  }
  void let_go() {
    const std::lock_guard lock(mutex_);
    go_ = true;
    changed_.notify_all();
  }
  std::vector<std::int32_t> wait_for_notes(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(20), [&] { return notes_.size() >= count; });
    return notes_;
  }

  std::vector<PendingReply> kept;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool started_ = false;
  bool go_ = false;
  std::vector<std::int32_t> notes_;
};

class NodeTest : public testing::Test {
 protected:
  void serve() {
    options_.log = [this](const rt::LogRecord& record) {
      const std::lock_guard lock(mutex_);
      log_.push_back(record.message());
    };
    node_.emplace(options_);
    address_ = node_->listen("tcp://127.0.0.1:0").value();
    EXPECT_EQ(node_->add("camera", camera_).value(), 1u);
  }
  RawClient client() {
    if (!node_) serve();
    return RawClient(address_);
  }
  std::vector<std::string> log() {
    const std::lock_guard lock(mutex_);
    return log_;
  }

  NodeOptions options_;
  Camera camera_;
  std::mutex mutex_;
  std::vector<std::string> log_;
  Address address_;
  std::optional<Node> node_;
};

}  // namespace armature::ride
