// SPDX-License-Identifier: Apache-2.0
#include "armature/tls/internal/connection.hpp"

#include <new>
#include <utility>

#include <openssl/err.h>
#include <openssl/x509v3.h>

#include "armature/platform/clock.hpp"
#include "armature/tls/internal/certificate.hpp"

namespace armature::tls::internal {

using platform::StreamSocket;
using platform::StreamStatus;
using ride::Progress;

TlsConnection::TlsConnection(std::unique_ptr<StreamSocket> socket, SSL_CTX& context)
    : wire_(std::move(socket)), ssl_(SSL_new(&context)) {
  BioPointer bio = make_bio(wire_);
  if (!ssl_ || !bio) throw std::bad_alloc();
  BIO* const both_ways = bio.release();
  SSL_set_bio(ssl_.get(), both_ways, both_ways);
  note_verdict(*ssl_, verdict_);
}

std::unique_ptr<TlsConnection> TlsConnection::accepted(std::unique_ptr<StreamSocket> socket,
                                                       SSL_CTX& context) {
  std::unique_ptr<TlsConnection> made(new TlsConnection(std::move(socket), context));
  SSL_set_accept_state(made->ssl_.get());
  return made;
}

std::unique_ptr<TlsConnection> TlsConnection::dialled(std::unique_ptr<StreamSocket> socket,
                                                      SSL_CTX& context,
                                                      const ride::Address& dialled) {
  std::unique_ptr<TlsConnection> made(new TlsConnection(std::move(socket), context));
  SSL* const ssl = made->ssl_.get();
  SSL_set_connect_state(ssl);
  const bool by_name = !dialled.name.empty();
  made->verdict_.dialled = by_name ? dialled.name : dialled.host;
  // The common name is who it is, not where: only names made to be dialled count.
  SSL_set_hostflags(ssl,
                    X509_CHECK_FLAG_NO_PARTIAL_WILDCARDS | X509_CHECK_FLAG_NEVER_CHECK_SUBJECT);
  const bool is_checked =
      by_name ? SSL_set1_host(ssl, dialled.name.c_str()) == 1 &&
                    SSL_set_tlsext_host_name(ssl, dialled.name.c_str()) == 1
              : X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(ssl), dialled.host.c_str()) == 1;
  if (!is_checked) made->gone("'" + made->verdict_.dialled + "' is not a name that can be checked");
  return made;
}

TlsConnection::~TlsConnection() { shut_down(); }

Progress TlsConnection::gone(std::string problem) {
  state_ = State::kGone;
  problem_ = std::move(problem);
  return Progress::kGone;
}

/// What the session says of an attempt that has not succeeded.
Progress TlsConnection::after(int result) {
  const int error = SSL_get_error(ssl_.get(), result);
  const bool is_hopeless = state_ != State::kUp && !may_speak_tls(wire_);
  if (error == SSL_ERROR_WANT_READ && !is_hopeless) return Progress::kWantRead;
  if (error == SSL_ERROR_WANT_WRITE) return Progress::kWantWrite;
  return gone(state_ == State::kUp ? why_ended(wire_, error) : why_refused(wire_, verdict_));
}

Progress TlsConnection::establish() {
  const std::lock_guard lock(mutex_);
  if (state_ == State::kUp) return Progress::kDone;
  if (state_ == State::kGone) return Progress::kGone;
  if (state_ == State::kConnecting) {
    const StreamStatus status = wire_.socket->finish_connect();
    if (status == StreamStatus::kLater) return Progress::kWantWrite;
    if (status == StreamStatus::kGone) return gone(wire_.socket->problem());
    state_ = State::kHandshake;
  }
  ERR_clear_error();
  const int result = SSL_do_handshake(ssl_.get());
  if (result != 1) return after(result);
  identity_ = identity_of(*SSL_get0_peer_certificate(ssl_.get()));
  state_ = State::kUp;
  return Progress::kDone;
}

Progress TlsConnection::send(std::span<const std::byte> bytes, std::size_t& sent) {
  const std::lock_guard lock(mutex_);
  if (state_ != State::kUp) return Progress::kGone;
  ERR_clear_error();
  const int result = SSL_write_ex(ssl_.get(), bytes.data(), bytes.size(), &sent);
  return result == 1 ? Progress::kDone : after(result);
}

Progress TlsConnection::receive(std::span<std::byte> room, std::size_t& size) {
  const std::lock_guard lock(mutex_);
  if (state_ != State::kUp) return Progress::kGone;
  ERR_clear_error();
  const int result = SSL_read_ex(ssl_.get(), room.data(), room.size(), &size);
  return result == 1 ? Progress::kDone : after(result);
}

StreamStatus TlsConnection::wait_for(Progress wanted, base::Duration limit) const {
  return wanted == Progress::kWantRead ? wire_.socket->wait_until_readable(limit)
                                       : wire_.socket->wait_until_writable(limit);
}

/// What wakes it may be less than a whole record, and an answer of TLS itself may be in the way.
Progress TlsConnection::wait_and_receive(std::span<std::byte> room, std::size_t& size,
                                         base::Duration limit) {
  const base::Time end = base::later(platform::monotonic_now(), limit);
  Progress progress = receive(room, size);
  while ((progress == Progress::kWantRead || progress == Progress::kWantWrite) &&
         limit > base::Duration::zero() && wait_for(progress, limit) == StreamStatus::kDone) {
    progress = receive(room, size);
    limit = end - platform::monotonic_now();
  }
  return progress;
}

/// The other side is told that this is the end and not a cut, if that can be sent without waiting.
void TlsConnection::shut_down() {
  const std::lock_guard lock(mutex_);
  if (state_ == State::kUp) {
    ERR_clear_error();
    SSL_shutdown(ssl_.get());
    ERR_clear_error();
  }
  wire_.socket->shut_down();
}

std::string TlsConnection::other_end() const {
  const std::lock_guard lock(mutex_);
  const std::string& address = wire_.socket->other_end();
  return identity_.empty() ? address : address + " (" + identity_ + ")";
}

std::string TlsConnection::identity() const {
  const std::lock_guard lock(mutex_);
  return identity_;
}

std::string TlsConnection::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

}  // namespace armature::tls::internal
