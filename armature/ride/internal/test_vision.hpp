// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: what rcidl writes for the vision component of paper 4 (Table 4), and more of its kind.

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "armature/ride/placeholder.hpp"
#include "armature/ride/service.hpp"

namespace armature::ride {

struct ObjectPosition {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend bool operator==(const ObjectPosition&, const ObjectPosition&) = default;
};
inline void encode(Encoder& to, const ObjectPosition& value) {
  to.put(value.x);
  to.put(value.y);
}
inline bool decode(Decoder& from, ObjectPosition& value) {
  return from.take(value.x) && from.take(value.y);
}
constexpr Number event_number(const ObjectPosition*) {
  return number_of("event ObjectPosition{int,int}");
}

inline constexpr Declaration kVisionDeclarations[] = {
    {"int initialize()", Access::kConfigure},
    {"int setThreshold(unsigned int,unsigned int,unsigned int)", Access::kConfigure},
    {"void start()"},
    {"void note(int)"},
    {"String echo(String)", Access::kRead},
    {"int later()"},
    {"event ObjectPosition{int,int}", Access::kRead},
};
inline constexpr Interface kVision{"Vision", kVisionDeclarations};

inline constexpr Number kInitialize = number_of("int initialize()");
inline constexpr Number kSetThreshold =
    number_of("int setThreshold(unsigned int,unsigned int,unsigned int)");
inline constexpr Number kStart = number_of("void start()");
inline constexpr Number kNote = number_of("void note(int)");
inline constexpr Number kEcho = number_of("String echo(String)");
inline constexpr Number kLater = number_of("int later()");

class VisionPlaceholder : public Placeholder {
 public:
  VisionPlaceholder(Peer& peer, std::string name) : Placeholder(peer, std::move(name), kVision) {}
  /// As one whose definition is another.
  VisionPlaceholder(Peer& peer, std::string name, const Interface& interface)
      : Placeholder(peer, std::move(name), interface) {}

  Answer<std::int32_t> initialize(CallOptions options = {}) {
    return request<std::int32_t>(kInitialize, "initialize", options);
  }
  Answer<std::int32_t> setThreshold(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                    CallOptions options = {}) {
    return request<std::int32_t>(kSetThreshold, "setThreshold", options, a, b, c);
  }
  Sent start(Priority priority = {}) { return command(kStart, priority); }
  Sent note(std::int32_t what, Priority priority = {}) { return command(kNote, priority, what); }
  Answer<std::string> echo(const std::string& text, CallOptions options = {}) {
    return request<std::string>(kEcho, "echo", options, text);
  }
  Answer<std::int32_t> later(CallOptions options = {}) {
    return request<std::int32_t>(kLater, "later", options);
  }
  Answer<std::int32_t> unknown(CallOptions options = {}) {
    return request<std::int32_t>(number_of("int unknown()"), "unknown", options);
  }
  Answer<std::int32_t> malformed(CallOptions options = {}) {
    return request<std::int32_t>(kInitialize, "initialize", options, std::uint8_t{1});
  }
  Subscription on_ObjectPosition(std::function<void(const ObjectPosition&)> handler) {
    return subscribe<ObjectPosition>(std::move(handler));
  }
};

class VisionService : public Service {
 public:
  VisionService() : Service(kVision) {}

  virtual std::int32_t initialize() { return 0; }
  virtual std::int32_t setThreshold(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return static_cast<std::int32_t>(a + b + c);
  }
  virtual void start() {}
  virtual void note(std::int32_t) {}
  virtual std::string echo(const std::string& text) { return text; }
  virtual void later(PendingReply reply) { reply.put(std::int32_t{0}); }

  void raise(const ObjectPosition& event) { publish(event); }
  void alarm(const Failed& event, Priority priority) { publish(event, priority); }

 private:
  Executed execute(Number operation, Decoder& parameters, Reply& reply) override {
    switch (operation) {
      case kInitialize:
        if (!parameters.ended()) return Executed::kMalformed;
        reply.put(initialize());
        return Executed::kDone;
      case kSetThreshold: {
        std::uint32_t a = 0;
        std::uint32_t b = 0;
        std::uint32_t c = 0;
        if (!parameters.take(a) || !parameters.take(b) || !parameters.take(c) ||
            !parameters.ended()) {
          return Executed::kMalformed;
        }
        reply.put(setThreshold(a, b, c));
        return Executed::kDone;
      }
      case kStart:
        if (!parameters.ended()) return Executed::kMalformed;
        start();
        reply.done();
        return Executed::kDone;
      case kNote: {
        std::int32_t what = 0;
        if (!parameters.take(what) || !parameters.ended()) return Executed::kMalformed;
        note(what);
        reply.done();
        return Executed::kDone;
      }
      case kEcho: {
        std::string text;
        if (!parameters.take(text) || !parameters.ended()) return Executed::kMalformed;
        reply.put(echo(text));
        return Executed::kDone;
      }
      case kLater:
        if (!parameters.ended()) return Executed::kMalformed;
        later(reply.keep());
        return Executed::kDone;
      default:
        return Executed::kNoSuchOperation;
    }
  }
};

}  // namespace armature::ride
