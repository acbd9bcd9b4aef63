// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/component/input_port.hpp"
#include "armature/component/port.hpp"
#include "armature/component/stand_in.hpp"
#include "armature/component/tap.hpp"

namespace armature::component {

namespace internal {
class PortTapBase;
}  // namespace internal
using AttachedTap = internal::PortTapBase;

/// What losses an output saw.
struct OutputCounters {
  std::uint64_t refused = 0;     ///< values that a full FIFO did not take
  std::uint64_t dropped = 0;     ///< values that were dropped from a full FIFO to make room
  std::uint64_t wrong_size = 0;  ///< writes of a vector of another size
};

/// What output ports of all types have in common.
class OutputPortBase : public PortBase {
 public:
  ~OutputPortBase() override;

  OutputCounters counters() const { return about().counters; }
  const std::vector<InputPortBase*>& readers() const { return about().readers; }

  /// Connects `input`, which has the same type (see exec's checks), for the threads that both
  /// components are assigned to.
  /// @thread configuration only
  virtual void connect(InputPortBase& input, const ConnectionPolicy& policy) = 0;
  void disconnect_all();
  /// `input` is no reader any more.
  void forget(InputPortBase& input);

  /// `writer`, which feeds an input that this port feeds too, is what this port takes over from as
  /// its component starts; nullptr: nothing.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  void take_over_from(const OutputPortBase* writer) { about().predecessor = writer; }

  /// Has every n-th sample from the first on go to a tap as well, which lives until
  /// `disconnect_all`. It is no reader: a write says what it would say without.
  /// @param capacity  samples that it holds
  /// @thread configuration only, once the port has its shape
  Tap& tap(std::size_t capacity, std::uint64_t every = 1);
  bool is_tapped() const { return !about().taps.empty() || about().first_attached != nullptr; }

  /// A tap to be attached: for who comes and goes while the application runs.
  /// @param shape  a value of the port's type, of the shape that the port has
  /// @thread any
  virtual std::unique_ptr<AttachedTap> make_tap(std::size_t capacity, const void* shape) const = 0;
  /// From now on every sample goes to `tap` as well, until it is detached, which it is before it
  /// goes.
  /// @rt nonblocking, no allocation, O(taps)
  /// @thread the component's own
  void attach(AttachedTap& tap);
  void detach(AttachedTap& tap);

  /// An output of the same name and type, which `owner` writes by `write_from`; it keeps what this
  /// one is made of, which outlives it.
  /// @thread configuration only
  virtual std::unique_ptr<OutputPortBase> twin(StandIn& owner) const = 0;
  /// Writes a value of the port's type.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  virtual WriteStatus write_from(const void* value) noexcept = 0;

  /// Gives vectors their declared size; the number of elements of the current value otherwise.
  virtual void prepare() = 0;
  /// True if `input` expects vectors of the size that this port writes.
  virtual bool fits(const InputPortBase& input) const = 0;

 protected:
  /// Description, counters and lists, apart from what a cycle touches.
  struct About : PortBase::About {
    using PortBase::About::About;
    ~About() override;
    OutputCounters counters;
    std::vector<InputPortBase*> readers;
    std::vector<InputPortBase*> triggered;  ///< readers in this thread whose handlers run now
    std::vector<internal::ChannelBase*> channels;
    std::vector<std::unique_ptr<internal::PortTapBase>> taps;
    AttachedTap* first_attached = nullptr;
    const OutputPortBase* predecessor = nullptr;
  };
  OutputPortBase(Component& owner, std::unique_ptr<About> about) noexcept;

  About& about() const { return static_cast<About&>(PortBase::about()); }

  /// `input` reads the value where it is.
  void add_reader(InputPortBase& input);
  /// `input` is given samples by `made_channel`; the last one, `sample`, at once.
  void add_reader(InputPortBase& input, std::unique_ptr<internal::ChannelBase> made_channel,
                  const void* sample, std::uint64_t sequence);
  /// Apart, so that they add nothing to the common case.
  WriteStatus deliver(const void* sample) noexcept;
  void run_measured(InputPortBase& input) noexcept;

  /// What a write has to do for its readers.
  enum class Delivery : std::uint8_t { kNothing, kHandler, kChannel, kSeveral };
  /// The one reader's handler or channel; `Delivery` says which.
  union Only {
    InputPortBase* handler = nullptr;
    internal::ChannelBase* channel;
  };
  Only only_;
  Delivery delivery_ = Delivery::kNothing;
  WriteStatus unread_ = WriteStatus::kNotConnected;  ///< what a write that has nothing to do says

 private:
  virtual std::unique_ptr<internal::PortTapBase> make_own_tap(std::size_t capacity,
                                                              std::uint64_t every) = 0;
  void choose_delivery();
  void note(rt::PushResult result, WriteStatus& status);
};

/// Writes typed data to any number of inputs.
///
/// The written value lives in the port itself. A reader in the same thread reads it there: writing
/// costs one copy whatever the number of readers. Readers in other threads, FIFOs and delayed
/// readers each have a channel.
template <typename T>
class OutputPort final : public OutputPortBase {
  static_assert(PortData<T>, ARMATURE_INTERNAL_PORT_DATA_TEXT);

 public:
  /// Name, documentation and unit are literals. Options: size_of(property, factor).
  template <typename... Options>
  OutputPort(Component* owner, std::string_view name, std::string_view doc,
             std::string_view unit = {}, Options... options) noexcept
      : OutputPort(*owner, name, doc, unit) {
    (apply(options), ...);
  }
  ~OutputPort() override;

  /// Writes `value` and runs the handlers that are to run on it in this thread.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  [[gnu::always_inline]] WriteStatus write(const T& value) noexcept {
    if constexpr (!std::is_trivially_copyable_v<T>) {
      return write_shaped(value);
    } else {
      sample_.value = value;
      return tell();
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
    const OutputPortBase* const predecessor = about().predecessor;
    return predecessor == nullptr ? nullptr : static_cast<const T*>(predecessor->current());
  }

  const void* current() const override;
  base::Time current_time() const override;
  std::uint64_t current_sequence() const override;
  void prepare() override;
  bool fits(const InputPortBase& input) const override;
  void connect(InputPortBase& base, const ConnectionPolicy& policy) override;
  std::unique_ptr<AttachedTap> make_tap(std::size_t capacity, const void* shape) const override;
  std::unique_ptr<OutputPortBase> twin(StandIn& owner) const override;
  WriteStatus write_from(const void* value) noexcept override;

 private:
  template <typename Port>
  friend class PortArray;
  template <typename Other>
  friend class InputPort;
  OutputPort(Component& owner, std::string_view name, std::string_view doc,
             std::string_view unit) noexcept;

  std::unique_ptr<internal::ChannelBase> make_channel(InputPortBase& input,
                                                      const ConnectionPolicy& policy,
                                                      bool same_thread);
  std::unique_ptr<internal::PortTapBase> make_own_tap(std::size_t capacity,
                                                      std::uint64_t every) override;
  [[gnu::noinline]] WriteStatus write_shaped(const T& value) noexcept;

  [[gnu::always_inline]] WriteStatus tell() noexcept {
    Component& writer = owner();
    sample_.time = writer.time();
    ++sample_.sequence;
    if (delivery_ != Delivery::kHandler) {
      return delivery_ == Delivery::kNothing ? unread_ : deliver(&sample_);
    }
    ExecutionContext& where = writer.context();
    if (where.measuring) [[unlikely]] {
      run_measured(*only_.handler);
    } else {
      only_.handler->arrived(where);
    }
    return WriteStatus::kWritten;
  }

  Sample<T> sample_{};
};

// Compiled once, in the library.
extern template class OutputPort<bool>;
extern template class OutputPort<int>;
extern template class OutputPort<double>;
extern template class OutputPort<std::vector<double>>;

}  // namespace armature::component

#include "armature/component/internal/output_port_definitions.hpp"
