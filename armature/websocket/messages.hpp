// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/ride/transport.hpp"

namespace armature::websocket {

/// A message of a client, or what became of it.
struct Incoming {
  /// What the client has done.
  enum class Kind : std::uint8_t { kCame, kText, kBinary, kGone };

  std::uint32_t client = 0;  ///< its number, from 1, which no other gets
  Kind kind = Kind::kCame;
  std::string content{};
  /// Of who came: its own connection to the node that listens there, where it has the identity of
  /// the options. What is asked by it is under the node's policy.
  std::unique_ptr<ride::Connection> inside{};
};

/// A message to a client.
struct Outgoing {
  bool text = false;
  std::string content{};
};

/// Clients that speak another protocol than RIDE at the addresses of pages, in whole messages. Who
/// knows the address with its secret comes in, from wherever its page is: no cookie counts here.
///
/// What waits for a client is bounded, and so is what waits of it: who takes nothing loses values,
/// and is disconnected after `websocket::Options::time_to_take`; who asks faster than it is
/// answered is read from no further. Neither costs another client anything.
class Messages {
 public:
  /// Which protocol, and what a client may take.
  struct Options {
    std::string subprotocol{};  ///< as clients ask for it
    std::string path{};         ///< behind which the secret stands: `/foxglove/`
    std::string identity{};     ///< of its clients: `foxglove`, in policies `foxglove@web`
    std::size_t clients = 8;
    std::size_t message_bytes = 256 * 1024;  ///< of a client; a larger message ends the connection
    std::size_t asked = 64;                  ///< messages of a client that wait for `take`
    std::size_t queue_bytes = 1 << 20;       ///< that wait for a client when values are dropped
    std::size_t most_bytes = 16 << 20;       ///< that wait for a client when it is disconnected
  };

  explicit Messages(Options options) : options_(std::move(options)) {}

  const Options& options() const { return options_; }

  // The side of who answers, in any thread.

  /// What has come; waits for it, at most so long.
  std::vector<Incoming> take(base::Duration limit);
  /// Ends a `take` that waits.
  void wake();
  /// What is lost if too much waits for the client already.
  /// @return false: it is lost, or the client has gone
  bool offer(std::uint32_t client, std::string binary);
  /// What must not be lost: the client is disconnected if it does not take it.
  void send(std::uint32_t client, std::string text) { send(client, {true, std::move(text)}); }
  void send_binary(std::uint32_t client, std::string binary) {
    send(client, {false, std::move(binary)});
  }
  /// Where clients connect, with the secret: `ws://127.0.0.1:8080/foxglove/0123...`.
  std::vector<std::string> addresses() const;

  // The side of who carries messages.

  /// @param ring  called by any thread, and not after `leave`, when `next` may have something, or
  ///              `reads` is another than before
  /// @return the client's number; nothing if there are too many
  std::optional<std::uint32_t> enter(std::function<void()> ring,
                                     std::unique_ptr<ride::Connection> inside);
  void leave(std::uint32_t client);
  void receive(std::uint32_t client, bool text, std::string content);
  /// More of the client is to be read.
  bool reads(std::uint32_t client) const;
  /// The client is to be disconnected.
  bool gives_up(std::uint32_t client) const;
  std::optional<Outgoing> next(std::uint32_t client);
  bool has_next(std::uint32_t client) const;
  void add_address(std::string address);

 private:
  struct Client {
    std::function<void()> ring;
    std::deque<Outgoing> queue{};
    std::size_t queued_bytes = 0;
    std::size_t asked = 0;
    bool given_up = false;
  };

  void send(std::uint32_t client, Outgoing message);
  void put(Client& client, Outgoing message);

  const Options options_;
  mutable std::mutex mutex_;  ///< of all below
  std::condition_variable came_;
  bool woken_ = false;
  std::uint32_t last_ = 0;
  std::map<std::uint32_t, Client> clients_;
  std::vector<Incoming> incoming_;
  std::vector<std::string> addresses_;
};

}  // namespace armature::websocket
