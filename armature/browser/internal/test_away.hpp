// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: the small robot in simulated time, controlled by a thread of its own, and the browser
// of another process that looks at it through two nodes.

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "armature/browser/internal/remote_browsing.hpp"
#include "armature/browser/internal/test_screen.hpp"
#include "armature/remote/control_queue.hpp"
#include "armature/remote/inspector.hpp"
#include "armature/ride/node.hpp"

namespace armature::browser::test {

/// Time passes for the robot when the browser waits.
class Away {
 public:
  Away() : inspector_(bench.application(), queue_), controller_([this] { control(); }) {
    EXPECT_TRUE(node_.add(remote::Inspector::kName, inspector_.service()).ok());
    ride::Peer& peer = client_.connect(node_.listen("tcp://127.0.0.1:0").value().text());
    view_ = std::make_unique<remote::PeerView>(peer);
    EXPECT_TRUE(peer.wait_until_connected(20s).ok());
    remote_ = std::make_unique<internal::RemoteBrowsing>(
        *view_, screen, [this](base::Duration time) { pass(time); });
    browser = &remote_->browser;
  }
  ~Away() {
    remote_.reset();
    view_.reset();
    node_.remove(inspector_.service());
    over_ = true;
    controller_.join();
    queue_.close();
  }

  /// What typing `text`, of one line or several, gives.
  std::string type(std::string_view text) {
    screen.lines.clear();
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      browser->take(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    std::string all;
    for (const std::string& line : screen.lines) all += (all.empty() ? "" : "\n") + line;
    return all;
  }
  void pass(base::Duration time) {
    to_pass_ = time.count();
    while (to_pass_ > 0) std::this_thread::yield();
  }

  SmallRobot bench;
  Screen screen;
  internal::TaskBrowser* browser = nullptr;

 private:
  void control() {
    while (!over_) {
      queue_.run();
      if (to_pass_ > 0) {
        bench.application().run_for(base::Duration(to_pass_.load()));
        to_pass_ = 0;
      }
      std::this_thread::yield();
    }
  }

  remote::ControlQueue queue_;
  remote::Inspector inspector_;
  std::atomic<bool> over_{false};
  std::atomic<base::Duration::rep> to_pass_{0};
  std::thread controller_;
  ride::Node node_;
  ride::Node client_;
  std::unique_ptr<remote::PeerView> view_;
  std::unique_ptr<internal::RemoteBrowsing> remote_;
};

}  // namespace armature::browser::test
