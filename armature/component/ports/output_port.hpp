// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <type_traits>
#include <vector>

#include "armature/component/internal/inside.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/port.hpp"

namespace armature::component {

class AttachedTap;
class Tap;

/// What losses an output saw.
struct OutputCounters {
  std::uint64_t refused = 0;     ///< values that a full FIFO did not take
  std::uint64_t dropped = 0;     ///< values that were dropped from a full FIFO to make room
  std::uint64_t wrong_size = 0;  ///< writes of a vector of another size

  bool operator==(const OutputCounters&) const = default;
};

/// What output ports of all types have in common: the runtime's side of them, which authors do not
/// see.
class OutputPortBase : public PortBase {
 public:
  ~OutputPortBase() override;

  OutputCounters counters() const;
  const std::vector<InputPortBase*>& readers() const;

  const void* current() const final;
  base::Time current_time() const final;
  std::uint64_t current_sequence() const final;

  /// Connects `input`, which has the same type (see exec's checks), for the threads that both
  /// components are assigned to.
  /// @thread configuration only
  void connect(InputPortBase& input, const ConnectionPolicy& policy);
  void disconnect_all();
  /// `input` is no reader any more.
  void forget(InputPortBase& input);

  /// `writer`, which feeds an input that this port feeds too, is what this port takes over from as
  /// its component starts; nullptr: nothing.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  void take_over_from(const OutputPortBase* writer);

  /// Has every n-th sample from the first on go to a tap as well, which lives until
  /// `disconnect_all`. It is no reader: a write says what it would say without.
  /// @param capacity  samples that it holds
  /// @thread configuration only, once the port has its shape
  Tap& tap(std::size_t capacity, std::uint64_t every = 1);
  bool is_tapped() const;

  /// A tap to be attached: for who comes and goes while the application runs.
  /// @param shape  a value of the port's type, of the shape that the port has
  /// @thread any
  std::unique_ptr<AttachedTap> make_tap(std::size_t capacity, const void* shape) const;
  /// From now on every sample goes to `tap` as well, until it is detached, which it is before it
  /// goes.
  /// @rt nonblocking, no allocation, O(taps)
  /// @thread the component's own
  void attach(AttachedTap& tap);
  void detach(AttachedTap& tap);

  /// An output of the same name and type, which `owner` writes by `write_from`; it keeps what this
  /// one is made of, which outlives it.
  /// @thread configuration only
  std::unique_ptr<OutputPortBase> twin(StandIn& owner) const;
  /// Writes a value of the port's type.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  WriteStatus write_from(const void* value) noexcept;

  /// Gives vectors their declared size; the number of elements of the current value otherwise.
  void prepare();
  /// True if `input` expects vectors of the size that this port writes.
  bool fits(const InputPortBase& input) const;

 protected:
  /// @param sample  of the declared type, which the port holds
  OutputPortBase(Component& owner, const PortDeclaration& declaration, void* sample) noexcept;

  /// What this port takes over from; nullptr: nothing.
  const OutputPortBase* predecessor() const;

  /// Tells the readers of a sample that was written, and says what became of it.
  [[gnu::always_inline]] WriteStatus tell(const void* sample) noexcept {
    if (delivery_ != Delivery::kHandler) {
      return delivery_ == Delivery::kNothing ? unread_ : deliver(sample);
    }
    ExecutionContext& where = internal::Inside::context(owner());
    if (where.measuring) [[unlikely]] {
      run_measured(*only_.handler);
    } else {
      only_.handler->arrived(where);
    }
    return WriteStatus::kWritten;
  }
  /// Apart, so that they add nothing to the common case.
  WriteStatus deliver(const void* sample) noexcept;
  WriteStatus refuse_size() noexcept;
  void run_measured(InputPortBase& input) noexcept;

  /// What a write has to do for its readers.
  enum class Delivery : std::uint8_t { kNothing, kHandler, kChannel, kSeveral };
  /// The one reader's handler or channel; `Delivery` says which.
  union Only {
    InputPortBase* handler = nullptr;
    internal::Channel* channel;
  };
  Only only_;
  Delivery delivery_ = Delivery::kNothing;
  WriteStatus unread_ = WriteStatus::kNotConnected;  ///< what a write that has nothing to do says

 private:
  friend class InputPortBase;
  struct About;
  class Erased;

  About& about() const;
  /// `input` reads the value where it is.
  void add_reader(InputPortBase& input);
  /// `input` is given samples by `made_channel`; the last one at once.
  void add_reader(InputPortBase& input, std::unique_ptr<internal::Channel> made_channel);
  void choose_delivery();
  void note(rt::PushResult result, WriteStatus& status);
};

namespace internal {
template <typename T>
bool same_shape(const T& a, const T& b) {
  return types::same_shape(types::type_of<T>(), &a, &b);
}
/// The usual case, without a look at the type's description.
template <typename E>
requires std::is_trivially_copyable_v<E>
bool same_shape(const std::vector<E>& a, const std::vector<E>& b) { return a.size() == b.size(); }
}  // namespace internal

/// Writes typed data to any number of inputs.
///
/// The written value lives in the port itself. A reader in the same thread reads it there: writing
/// costs one copy whatever the number of readers. Readers in other threads, FIFOs and delayed
/// readers each have a channel.
template <typename T>
class OutputPort final : private OutputPortBase {
  static_assert(PortData<T>, ARMATURE_INTERNAL_PORT_DATA_TEXT);

 public:
  using OutputPortBase::name;
  using OutputPortBase::operator new;
  using OutputPortBase::operator delete;

  /// Name, documentation and unit are literals. Options: size_of(property, factor),
  /// unit_of(property).
  template <typename... Options>
  OutputPort(Component* owner, std::string_view name, std::string_view doc,
             std::string_view unit = {}, Options... options) noexcept
      : OutputPort(*owner, name, doc, unit) {
    (apply(options), ...);
  }

  /// Writes `value` and runs the handlers that are to run on it in this thread.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  [[gnu::always_inline]] WriteStatus write(const T& value) noexcept {
    if constexpr (!std::is_trivially_copyable_v<T>) {
      return write_shaped(value);
    } else {
      sample_.value = value;
      return tell_written();
    }
  }

  /// Gives the port its shape, e.g. a vector its size, where no property declares it.
  /// @thread configuration only, before the connections are made
  void set_sample(const T& value) { sample_.value = T(value); }

  /// The value last written.
  const T& last() const { return sample_.value; }

  /// For `on_start`: what the readers of this port have from the writer whose place it takes, if
  /// the component starts because modes are switched; nullptr at every other start.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  const T* taken_over() const {
    const OutputPortBase* const before = predecessor();
    return before == nullptr ? nullptr : static_cast<const T*>(before->current());
  }

 private:
  using RuntimeFace = OutputPortBase;
  friend class internal::Inside;
  template <typename Port>
  friend class PortArray;
  OutputPort(Component& owner, std::string_view name, std::string_view doc,
             std::string_view unit) noexcept
      : OutputPortBase(owner, {name, doc, unit, types::type_of<T>(), internal::is_small<T>},
                       &sample_) {}

  [[gnu::noinline]] WriteStatus write_shaped(const T& value) noexcept {
    if (!internal::same_shape(sample_.value, value)) return refuse_size();
    sample_.value = value;
    return tell_written();
  }

  [[gnu::always_inline]] WriteStatus tell_written() noexcept {
    sample_.time = owner().time();
    ++sample_.sequence;
    return tell(&sample_);
  }

  Sample<T> sample_{};
};

// Compiled once, in the library.
extern template class OutputPort<bool>;
extern template class OutputPort<int>;
extern template class OutputPort<double>;
extern template class OutputPort<std::vector<double>>;

}  // namespace armature::component
