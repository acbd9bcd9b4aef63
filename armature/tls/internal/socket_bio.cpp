// SPDX-License-Identifier: Apache-2.0
#include "armature/tls/internal/socket_bio.hpp"

#include <cstddef>
#include <span>

namespace armature::tls::internal {
namespace {

using platform::StreamStatus;

Wire& wire_of(BIO* bio) { return *static_cast<Wire*>(BIO_get_data(bio)); }

int write(BIO* bio, const char* bytes, std::size_t size, std::size_t* written) {
  BIO_clear_retry_flags(bio);
  Wire& wire = wire_of(bio);
  const auto raw = std::as_bytes(std::span(bytes, size));
  switch (wire.socket->send(raw, *written)) {
    case StreamStatus::kDone:
      return 1;
    case StreamStatus::kLater:
      BIO_set_retry_write(bio);
      return 0;
    case StreamStatus::kGone:
      wire.failed = true;
      return 0;
  }
  return 0;
}

int read(BIO* bio, char* room, std::size_t size, std::size_t* received) {
  BIO_clear_retry_flags(bio);
  Wire& wire = wire_of(bio);
  switch (wire.socket->receive(std::as_writable_bytes(std::span(room, size)), *received)) {
    case StreamStatus::kDone:
      if (!wire.first) wire.first = static_cast<unsigned char>(room[0]);
      return 1;
    case StreamStatus::kLater:
      BIO_set_retry_read(bio);
      return 0;
    case StreamStatus::kGone:
      wire.ended = true;
      return 0;
  }
  return 0;
}

long control(BIO* bio, int command, long, void*) {
  if (command == BIO_CTRL_FLUSH) return 1;
  return command == BIO_CTRL_EOF && wire_of(bio).ended ? 1 : 0;
}

/// Made once and never freed: connections may outlive whatever order static objects end in.
BIO_METHOD* method() {
  static BIO_METHOD* const kMethod = [] {
    BIO_METHOD* const made = BIO_meth_new(BIO_get_new_index() | BIO_TYPE_SOURCE_SINK, "armature");
    BIO_meth_set_write_ex(made, write);
    BIO_meth_set_read_ex(made, read);
    BIO_meth_set_ctrl(made, control);
    return made;
  }();
  return kMethod;
}

}  // namespace

BioPointer make_bio(Wire& wire) {
  BioPointer bio(BIO_new(method()));
  BIO_set_data(bio.get(), &wire);
  BIO_set_init(bio.get(), 1);
  return bio;
}

}  // namespace armature::tls::internal
