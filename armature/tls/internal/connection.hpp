// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/ride/transport.hpp"
#include "armature/tls/internal/openssl.hpp"
#include "armature/tls/internal/reason.hpp"
#include "armature/tls/internal/socket_bio.hpp"

namespace armature::tls::internal {

/// One end of a TLS connection. OpenSSL's session takes one thread at a time: its lock is held
/// while bytes are encrypted and decrypted, never while one waits for them.
class TlsConnection final : public ride::Connection {
 public:
  /// The end of who listens.
  static std::unique_ptr<TlsConnection> accepted(std::unique_ptr<platform::StreamSocket> socket,
                                                 SSL_CTX& context);
  /// The end of who connects.
  /// @param dialled  the name that the other side's certificate has to be for, or its address
  static std::unique_ptr<TlsConnection> dialled(std::unique_ptr<platform::StreamSocket> socket,
                                                SSL_CTX& context, const ride::Address& dialled);
  ~TlsConnection() override;

  int handle() const override { return wire_.socket->handle(); }
  ride::Progress establish() override;
  bool establishes_slowly() const override { return true; }
  ride::Progress send(std::span<const std::byte> bytes, std::size_t& sent) override;
  ride::Progress receive(std::span<std::byte> room, std::size_t& size) override;
  ride::Progress wait_and_receive(std::span<std::byte> room, std::size_t& size,
                                  base::Duration limit) override;
  void set_level(int level) override { static_cast<void>(wire_.socket->set_priority(level)); }
  void shut_down() override;
  std::string other_end() const override;
  std::string identity() const override;
  std::string problem() const override;

 private:
  enum class State { kConnecting, kHandshake, kUp, kGone };

  TlsConnection(std::unique_ptr<platform::StreamSocket> socket, SSL_CTX& context);
  ride::Progress gone(std::string problem);
  ride::Progress after(int result);
  platform::StreamStatus wait_for(ride::Progress wanted, base::Duration limit) const;

  Wire wire_;
  Verdict verdict_;
  mutable std::mutex mutex_;
  const SslPointer ssl_;
  State state_ = State::kConnecting;
  std::string identity_;
  std::string problem_;
};

}  // namespace armature::tls::internal
