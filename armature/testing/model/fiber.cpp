// SPDX-License-Identifier: Apache-2.0
#include "armature/testing/model/fiber.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

#include <ucontext.h>

// The sanitizers want to be told of every change of the stack.
#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#elif defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace armature::testing::model {
namespace {

constexpr std::size_t kStackBytes = 256 * 1024;

/// One side of the switch: the fiber, or whoever resumed it.
struct Side {
  ucontext_t context{};
  const void* stack = nullptr;
  std::size_t stack_bytes = 0;
  void* sanitizer = nullptr;
};

void arrive([[maybe_unused]] Side& here, [[maybe_unused]] Side& came_from) {
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_finish_switch_fiber(here.sanitizer, &came_from.stack, &came_from.stack_bytes);
#endif
}

void switch_over(Side& here, Side& there) {
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_start_switch_fiber(&here.sanitizer, there.stack, there.stack_bytes);
#elif defined(__SANITIZE_THREAD__)
  __tsan_switch_to_fiber(there.sanitizer, 0);
#endif
  swapcontext(&here.context, &there.context);
  arrive(here, there);
}

}  // namespace

struct Fiber::State {
  std::unique_ptr<std::byte[]> stack = std::make_unique<std::byte[]>(kStackBytes);
  Side fiber;
  Side resumer;
  std::function<void()> task;

  void run() {
    arrive(fiber, resumer);
    while (true) {
      task();
      switch_over(fiber, resumer);
    }
  }

  // makecontext passes nothing but ints.
  static void enter(unsigned high, unsigned low) {
    const std::uint64_t address = (static_cast<std::uint64_t>(high) << 32) | low;
    reinterpret_cast<State*>(static_cast<std::uintptr_t>(address))->run();
  }
};

Fiber::Fiber() : state_(std::make_unique<State>()) {
  Side& side = state_->fiber;
  side.stack = state_->stack.get();
  side.stack_bytes = kStackBytes;
#if defined(__SANITIZE_THREAD__)
  side.sanitizer = __tsan_create_fiber(0);
  state_->resumer.sanitizer = __tsan_get_current_fiber();
#endif
  getcontext(&side.context);
  side.context.uc_stack.ss_sp = state_->stack.get();
  side.context.uc_stack.ss_size = kStackBytes;
  const auto address = static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(state_.get()));
  makecontext(&side.context, reinterpret_cast<void (*)()>(State::enter), 2,
              static_cast<unsigned>(address >> 32), static_cast<unsigned>(address));
}

Fiber::~Fiber() {
#if defined(__SANITIZE_THREAD__)
  __tsan_destroy_fiber(state_->fiber.sanitizer);
#endif
}

void Fiber::set_task(std::function<void()> task) { state_->task = std::move(task); }

void Fiber::resume() { switch_over(state_->resumer, state_->fiber); }

void Fiber::suspend() { switch_over(state_->fiber, state_->resumer); }

}  // namespace armature::testing::model
