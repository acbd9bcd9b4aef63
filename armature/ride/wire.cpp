// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/wire.hpp"

#include <algorithm>
#include <cstring>

namespace armature::ride {

std::string_view name_of(Type type) {
  switch (type) {
    case Type::kCommand:
      return "COMMAND";
    case Type::kRequest:
      return "REQUEST";
    case Type::kReply:
      return "REPLY";
    case Type::kEvent:
      return "EVENT";
    case Type::kControl:
      return "CONTROL";
  }
  return "unknown type";
}

std::string_view name_of(Code code) {
  switch (code) {
    case Code::kNone:
      return "NONE";
    case Code::kNoSuchComponent:
      return "NO_SUCH_COMPONENT";
    case Code::kNoSuchOperation:
      return "NO_SUCH_OPERATION";
    case Code::kMalformed:
      return "MALFORMED";
    case Code::kBadMagic:
      return "BAD_MAGIC";
    case Code::kTooLarge:
      return "TOO_LARGE";
    case Code::kNotAllowed:
      return "NOT_ALLOWED";
    case Code::kBusy:
      return "BUSY";
    case Code::kFailed:
      return "FAILED";
    case Code::kShuttingDown:
      return "SHUTTING_DOWN";
    case Code::kHello:
      return "HELLO";
    case Code::kPing:
      return "PING";
    case Code::kPong:
      return "PONG";
    case Code::kNotConnected:
      return "not connected";
    case Code::kDeadline:
      return "deadline passed";
    case Code::kConnectionLost:
      return "connection lost";
  }
  return "unknown code";
}

void write_header(std::byte* to, const Header& header) {
  const auto type = static_cast<std::uint16_t>(header.type);
  std::memcpy(to, Header::kMagic.data(), Header::kMagic.size());
  internal::store(to + 4, header.priority);
  internal::store(to + 8,
                  static_cast<std::uint16_t>(header.continues ? type | Header::kContinues : type));
  internal::store(to + 10, header.length);
  internal::store(to + 12, header.identifier);
}

std::optional<Header> read_header(const std::byte* from) {
  if (std::memcmp(from, Header::kMagic.data(), Header::kMagic.size()) != 0) return std::nullopt;
  const auto type = internal::load<std::uint16_t>(from + 8);
  Header header;
  header.priority = internal::load<std::uint32_t>(from + 4);
  header.type = static_cast<Type>(type & ~Header::kContinues);
  header.continues = (type & Header::kContinues) != 0;
  header.length = internal::load<std::uint16_t>(from + 10);
  header.identifier = internal::load<std::uint32_t>(from + 12);
  return header;
}

void encode(Encoder& to, const Control& control) {
  to.put(static_cast<std::uint32_t>(control.code));
  to.put(control.type);
  to.put(control.recipient);
  to.put(control.operation);
  to.put(control.text);
}

bool decode(Decoder& from, Control& control) {
  std::uint32_t code = 0;
  if (!from.take(code)) return false;
  control.code = static_cast<Code>(code);
  return from.take(control.type) && from.take(control.recipient) && from.take(control.operation) &&
         from.take(control.text);
}

void append_message(Body& to, Priority priority, Type type, std::uint32_t identifier,
                    std::span<const std::byte> body) {
  Header header{priority.level, type, true, Header::kMostLength, identifier};
  while (body.size() > Header::kMostBody) {
    write_header(to.extend(Header::kSize), header);
    to.append(body.first(Header::kMostBody));
    body = body.subspan(Header::kMostBody);
  }
  header.continues = false;
  header.length = static_cast<std::uint16_t>(Header::kSize + body.size());
  write_header(to.extend(Header::kSize), header);
  to.append(body);
}

void finish_message(Body& to, std::size_t start, Priority priority, Type type,
                    std::uint32_t identifier) {
  const std::size_t size = to.size() - start;
  if (size <= Header::kMostLength) {
    write_header(to.data() + start,
                 {priority.level, type, false, static_cast<std::uint16_t>(size), identifier});
    return;
  }
  const std::size_t body = size - Header::kSize;
  const std::size_t parts = (body + Header::kMostBody - 1) / Header::kMostBody;
  to.extend((parts - 1) * Header::kSize);
  // From the last to the first, which stays where it is: so none is written over.
  for (std::size_t i = parts; i-- != 0;) {
    const std::size_t begin = i * Header::kMostBody;
    const std::size_t length = std::min(body - begin, Header::kMostBody);
    std::byte* const at = to.data() + start + i * Header::kMostLength;
    std::memmove(at + Header::kSize, to.data() + start + Header::kSize + begin, length);
    write_header(at, {priority.level, type, i + 1 != parts,
                      static_cast<std::uint16_t>(Header::kSize + length), identifier});
  }
}

}  // namespace armature::ride
