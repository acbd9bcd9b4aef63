// SPDX-License-Identifier: Apache-2.0
// A thrown exception is one violation. What the language's runtime allocates, locks and frees for
// it, from the making of the exception to its catching and its end, is not reported once more.
#include <typeinfo>

#include "armature/guard/internal/watch.hpp"

namespace armature::guard {
namespace {

/// The thread is between the making of an exception and its catching.
constinit thread_local bool on_its_way = false;

void begin() {
  if (!on_its_way) ++own_business;
  on_its_way = true;
}

void end() {
  if (on_its_way) --own_business;
  on_its_way = false;
}

}  // namespace

ARMATURE_GUARD_EXPORT void* guarded_allocate(std::size_t) __asm__("__cxa_allocate_exception");
void* guarded_allocate(std::size_t size) {
  static constinit std::atomic<void* (*)(std::size_t)> behind{nullptr};
  if (watched()) [[unlikely]]
    begin();
  return next(behind, "__cxa_allocate_exception")(size);
}

ARMATURE_GUARD_EXPORT [[noreturn]] void guarded_throw(void*, std::type_info*,
                                                      void (*)(void*)) __asm__("__cxa_throw");
void guarded_throw(void* exception, std::type_info* type, void (*destroy)(void*)) {
  static constinit std::atomic<void (*)(void*, std::type_info*, void (*)(void*))> behind{nullptr};
  if (watched()) [[unlikely]] {
    end();
    note_violation("throw", path(type->name()), __builtin_return_address(0));
    begin();
  }
  next(behind, "__cxa_throw")(exception, type, destroy);
  __builtin_unreachable();
}

ARMATURE_GUARD_EXPORT void* guarded_begin_catch(void*) __asm__("__cxa_begin_catch");
void* guarded_begin_catch(void* exception) {
  static constinit std::atomic<void* (*)(void*)> behind{nullptr};
  end();
  return next(behind, "__cxa_begin_catch")(exception);
}

ARMATURE_GUARD_EXPORT void guarded_end_catch() __asm__("__cxa_end_catch");
void guarded_end_catch() {
  static constinit std::atomic<void (*)()> behind{nullptr};
  const OwnBusiness quiet;
  next(behind, "__cxa_end_catch")();
}

}  // namespace armature::guard
