// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "armature/ride/codec.hpp"
#include "armature/ride/wire.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::ride::internal {

/// A request whose answer has not come. All of it happens with the link's lock held, by whichever
/// thread reads the connection.
class OpenCall {
 public:
  virtual ~OpenCall() = default;
  /// @param holding  counts what the result takes while it is taken apart
  virtual void answered(std::span<const std::byte> result, Holding& holding) = 0;
  virtual void refused(Code code, std::string_view text) = 0;

  std::uint32_t id = 0;
  bool waits = false;  ///< for a thread that could read the connection instead
};

/// One that a thread waits for.
class WaitingCall final : public OpenCall {
 public:
  explicit WaitingCall(const Place& result) : result_(result) {}

  void answered(std::span<const std::byte> result, Holding& holding) override {
    Decoder from(result, &holding);
    if (result_.take(from)) {
      finish(Code::kNone);
    } else {
      refused(Code::kMalformed, "the answer is not a value of the result's type");
    }
  }
  void refused(Code why, std::string_view what) override {
    text = what;
    finish(why);
  }
  /// Tells the thread to look.
  void notify() { wakeup.notify(); }

  bool done = false;
  bool promoted = false;  ///< it reads from now on
  Code code = Code::kNone;
  std::string text;
  rt::BasicWakeup<rt::FutexParker> wakeup;

 private:
  void finish(Code why) {
    code = why;
    done = true;
    notify();
  }

  const Place& result_;
};

/// One that a function is called for; frees itself.
class CallbackCall final : public OpenCall {
 public:
  using Then = std::function<void(Code code, std::string_view text, std::span<const std::byte>)>;
  explicit CallbackCall(Then then) : then_(std::move(then)) {}

  void answered(std::span<const std::byte> result, Holding&) override {
    then_(Code::kNone, {}, result);
    delete this;
  }
  void refused(Code code, std::string_view text) override {
    then_(code, text, {});
    delete this;
  }

 private:
  Then then_;
};

}  // namespace armature::ride::internal
