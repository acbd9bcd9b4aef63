// SPDX-License-Identifier: Apache-2.0
#include "armature/testing/realtime_guard.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "armature/rt/loaded_guard.hpp"

namespace armature::testing {
namespace {

constexpr bool kCounts =
    std::string_view(ARMATURE_SANITIZER).find("realtime") == std::string_view::npos;

rt::Guard& the_guard() {
  rt::Guard* const guard = rt::loaded_guard();
  if (guard == nullptr) throw std::logic_error("libarmature_guard.so is not loaded");
  return *guard;
}

void allocate_once() {
  void* volatile memory = std::malloc(1);
  std::free(memory);
}

}  // namespace

RealtimeGuard::RealtimeGuard() {
  rt::Guard& guard = the_guard();
  guard.set_mode(rt::GuardMode::kCount);
  guard.reset();
  if (kCounts && watch(allocate_once) == 0) {
    throw std::logic_error(
        "libarmature_guard.so comes after the C library and sees nothing: link it first");
  }
  guard.reset();
}

RealtimeGuard::~RealtimeGuard() {
  the_guard().reset();
  the_guard().set_mode(rt::GuardMode::kReport);
}

std::uint64_t RealtimeGuard::violations() const { return the_guard().violations(); }

std::string RealtimeGuard::report() const { return the_guard().report(); }

}  // namespace armature::testing
