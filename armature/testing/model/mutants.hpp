// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/testing/model/atomics.hpp"

/// Atomics with a mistake, to be given to a structure instead of model::Atomics: a check that does
/// not notice is worth nothing.
namespace armature::testing::model {

constexpr Order without_release(Order order) {
  if (order == Order::acq_rel) return Order::acquire;
  return order == Order::release ? Order::relaxed : order;
}

constexpr Order without_acquire(Order order) {
  if (order == Order::acq_rel) return Order::release;
  return order == Order::acquire ? Order::relaxed : order;
}

/// Every operation in a weaker memory order.
template <Order (*Weaken)(Order)>
struct WeakenedAtomics {
  template <typename T>
  using Plain = Data<T>;
  template <typename T>
  class Atomic : public model::Atomic<T> {
    using Base = model::Atomic<T>;

   public:
    using Base::Base;
    T load(Order order) const { return Base::load(Weaken(order)); }
    void store(T value, Order order) { Base::store(value, Weaken(order)); }
    T exchange(T value, Order order) { return Base::exchange(value, Weaken(order)); }
    bool compare_exchange_strong(T& expected, T desired, Order success, Order failure) {
      return Base::compare_exchange_strong(expected, desired, Weaken(success), Weaken(failure));
    }
  };
};
using AtomicsWithoutRelease = WeakenedAtomics<without_release>;
using AtomicsWithoutAcquire = WeakenedAtomics<without_acquire>;

/// Read-modify-write operations in two steps: a load and a store.
struct AtomicsInTwoSteps {
  template <typename T>
  using Plain = Data<T>;
  template <typename T>
  class Atomic : public model::Atomic<T> {
    using Base = model::Atomic<T>;

   public:
    using Base::Base;
    T exchange(T value, Order order) {
      const T old = Base::load(without_release(order));
      Base::store(value, without_acquire(order));
      return old;
    }
    bool compare_exchange_strong(T& expected, T desired, Order success, Order failure) {
      const T old = Base::load(without_release(success));
      if (old == expected) {
        Base::store(desired, without_acquire(success));
        return true;
      }
      expected = Base::load(failure);
      return false;
    }
  };
};

/// The "it is set already, so there is nothing to do" that looks like a free gain.
struct AtomicsThatLookFirst {
  template <typename T>
  using Plain = Data<T>;
  template <typename T>
  class Atomic : public model::Atomic<T> {
    using Base = model::Atomic<T>;

   public:
    using Base::Base;
    T exchange(T value, Order order) {
      if (Base::load(Order::relaxed) == value) return value;
      return Base::exchange(value, order);
    }
  };
};

/// The parker of a wake-up with other atomics.
template <typename WithMistake>
struct ParkerOf : Parker {
  using Atomics = WithMistake;
};

}  // namespace armature::testing::model
