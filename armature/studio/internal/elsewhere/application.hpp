// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/remote/peer_view.hpp"
#include "armature/ride/node.hpp"
#include "armature/studio/internal/kept_lines.hpp"

namespace armature::studio::internal {

/// An application that runs elsewhere: whether it answers, what it is made of and what it logs, as
/// a thread of this asks it again and again. It comes back when the application does.
/// @thread any, where nothing else is said
class Elsewhere {
 public:
  struct Options {
    std::string address;
    std::vector<std::shared_ptr<ride::Transport>> transports;  ///< beside TCP and sockets
    std::function<void(const rt::LogRecord&)> log;
    std::function<void()> wake;  ///< called by the thread when something is other than before
  };

  explicit Elsewhere(Options options);
  Elsewhere(const Elsewhere&) = delete;
  Elsewhere& operator=(const Elsewhere&) = delete;
  ~Elsewhere();

  /// The first time, by the caller's thread; from then on its own asks. The error: nobody is there,
  /// no application, or it refuses.
  base::Result<void> find(base::Duration limit);
  /// Has it described anew: with what its properties are now.
  void read_anew();

  const std::string& address() const { return options_.address; }
  ride::Peer& peer() { return peer_; }

  /// How it stands.
  struct State {
    bool there = false;
    std::string trouble;  ///< why it is not
    bool simulated = false;
    std::int32_t number = 0;   ///< of the times that it came, from 1
    std::int32_t version = 0;  ///< of its description, from 1
    std::int32_t log_begin = 0;
    std::int32_t log_end = 0;

    bool operator==(const State&) const = default;
  };
  State state() const;
  /// In the form of a check (inspect::running_as_json), the last one.
  std::string description() const;
  std::vector<std::string> log(std::int32_t from, std::size_t count) const;

 private:
  void attend();
  void ask_for_news();
  void describe(bool came);
  void take_log();
  void lose(const std::string& why);
  void tell();

  const Options options_;
  ride::Node node_;
  ride::Peer& peer_;
  remote::PeerView view_;
  std::uint64_t last_line_ = 0;  ///< of the application's log; its thread's
  State told_;                   ///< likewise

  mutable std::mutex mutex_;  ///< of all below
  std::condition_variable ended_or_anew_;
  bool ending_ = false;
  bool anew_ = false;
  State state_;
  std::string description_;
  KeptLines log_;
  std::thread thread_;  ///< begun by `find`
};

}  // namespace armature::studio::internal
