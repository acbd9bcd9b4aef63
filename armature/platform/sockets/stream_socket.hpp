// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::platform {

/// What became of an attempt: kLater: nothing was possible yet; kGone: the connection has ended.
enum class StreamStatus { kDone, kLater, kGone };

/// One end of a connection over TCP or a socket file: bytes in their order, both ways.
/// @thread one may send while another receives; `shut_down` from any
class StreamSocket {
 public:
  /// Begins to connect; `finish_connect` tells when it is done.
  /// @param host  a numeric address
  static base::Result<std::unique_ptr<StreamSocket>> connect_tcp(const std::string& host,
                                                                 std::uint16_t port);
  static base::Result<std::unique_ptr<StreamSocket>> connect_file(const std::string& path);
  /// Two connected ends within this process.
  /// @param other_end  who is behind the second one, for whoever has the first
  static base::Result<std::pair<std::unique_ptr<StreamSocket>, std::unique_ptr<StreamSocket>>>
  make_pair(const std::string& other_end);
  StreamSocket(const StreamSocket&) = delete;
  StreamSocket& operator=(const StreamSocket&) = delete;
  ~StreamSocket();

  int handle() const { return socket_; }
  /// kLater until the handle can be written.
  StreamStatus finish_connect();

  /// Sends what can be sent without waiting; one system call.
  StreamStatus send(std::span<const std::byte> bytes, std::size_t& sent);
  /// Receives what is there; one system call that does not wait.
  StreamStatus receive(std::span<std::byte> room, std::size_t& size);
  /// The same, but waits; kLater once `limit` (> 0) has passed. One system call as long as the
  /// limit is the one of the call before.
  StreamStatus wait_and_receive(std::span<std::byte> room, std::size_t& size, base::Duration limit);
  /// kLater if nothing can be received before `limit` (> 0) has passed.
  StreamStatus wait_until_readable(base::Duration limit) const;
  /// kLater if nothing can be sent before `limit` (> 0) has passed.
  StreamStatus wait_until_writable(base::Duration limit) const;
  /// What is sent from now on goes before that of less urgent sockets of this machine.
  /// @param level  0 to 6, 6 most urgent, as the system lets every process have
  /// @return false if the system refuses
  bool set_priority(int level);
  /// Ends the connection both ways and whoever waits for it; the handle stays valid.
  void shut_down();

  const std::string& other_end() const { return other_end_; }
  /// Why it is gone.
  std::string problem() const;
  /// True if it is gone because the other side sends no more; it may still receive.
  bool ended_in_order() const { return error_ == 0; }
  /// The account of the process at the other end of a socket file: its name, or its number if it
  /// has none; empty for TCP. The kernel vouches for it.
  std::string peer_account() const;

 private:
  friend class StreamListener;
  StreamSocket(int socket, std::string other_end, bool connected)
      : socket_(socket), other_end_(std::move(other_end)), connected_(connected) {}
  StreamStatus after_receiving(std::ptrdiff_t received, std::size_t& size);
  void begin_to_flow();
  StreamStatus wait_until(short events, base::Duration limit) const;

  const int socket_;
  const std::string other_end_;
  bool connected_;
  std::atomic<int> error_ = 0;  ///< who sends and who receives may both find it gone
  base::Duration limit_{};      ///< how long the socket waits to receive; 0: forever
};

/// Where others connect to.
/// @thread one at a time
class StreamListener {
 public:
  /// @param host  a numeric address
  /// @param port  0: any that is free
  static base::Result<std::unique_ptr<StreamListener>> listen_tcp(const std::string& host,
                                                                  std::uint16_t port);
  /// Makes the socket file, in place of one that a process left which is no more.
  /// @param mode  its permissions: who may write may connect
  static base::Result<std::unique_ptr<StreamListener>> listen_file(const std::string& path,
                                                                   unsigned mode = 0600);
  StreamListener(const StreamListener&) = delete;
  StreamListener& operator=(const StreamListener&) = delete;
  /// Removes the socket file.
  ~StreamListener();

  int handle() const { return socket_; }
  /// The next who waits; none if there is none, or no descriptor for it.
  std::unique_ptr<StreamSocket> accept();
  std::uint16_t port() const { return port_; }

 private:
  StreamListener(int socket, std::string path, std::uint16_t port)
      : socket_(socket), path_(std::move(path)), port_(port) {}

  const int socket_;
  const std::string path_;  ///< of a socket file, else empty
  const std::uint16_t port_;
};

/// Another descriptor of the same socket, for a library that closes what it is given; -1: there is
/// none left.
int another_handle(int handle);

/// A numeric address as it is usually written: `::1` for `0:0:0:0:0:0:0:1`. A name stays.
std::string shortest_address(const std::string& host);

/// The numeric address of a host; waits for the name service if it is not numeric.
base::Result<std::string> look_up(const std::string& host);

/// True if `host` is a numeric address that only this machine reaches.
bool is_loopback(const std::string& host);

/// The account of this process, as the other ends of its socket files see it.
std::string own_account();

}  // namespace armature::platform
