// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <type_traits>
#include <vector>

#include "armature/component/context.hpp"
#include "armature/component/internal/inside.hpp"
#include "armature/component/operations/signature.hpp"
#include "armature/component/ports/port.hpp"

namespace armature::component {

class OutputPortBase;
class StandIn;
namespace internal {
class Channel;
}  // namespace internal

/// What a read found, and the value; `value` refers into the port until the next read, and in a
/// handler or hook until that ends.
template <typename T>
struct Reading {
  ReadStatus status;
  bool stale;  ///< older than the port's declared age
  const T& value;
  base::Time time;  ///< when it was written

  /// There is a value, and it is not stale.
  explicit operator bool() const { return status >= ReadStatus::kOld && !stale; }
  bool is_new() const { return status == ReadStatus::kNew; }
};

/// What losses an input saw.
struct InputCounters {
  std::uint64_t missed = 0;  ///< values that were overwritten or dropped before they were read
  std::uint64_t stale = 0;   ///< how often the data became older than declared
  std::uint64_t lost = 0;    ///< how often a writer faulted

  bool operator==(const InputCounters&) const = default;
};

/// Option of an input port: a write runs the component's update.
struct OnDataUpdate {};
inline constexpr OnDataUpdate on_data_update{};

/// What input ports of all types have in common: the runtime's side of them, which authors do not
/// see.
class InputPortBase : public PortBase {
 public:
  ~InputPortBase() override;

  bool triggers() const { return triggers_; }
  const LeadsTo& effects() const;
  bool allows_fan_in() const;
  bool connected() const;
  const std::vector<OutputPortBase*>& writers() const;
  bool ages() const;
  base::Duration max_age() const;
  Reaction stale_reaction() const;
  Reaction lost_reaction() const;
  InputCounters counters() const;

  const void* current() const final;
  base::Time current_time() const final;
  std::uint64_t current_sequence() const final;

  /// Declares an age from outside, as a deployment does for a connection.
  void set_max_age(MaxAge declared) { apply(declared); }
  void set_on_lost(OnLost declared) { apply(declared); }

  /// Reacts if the data is older than declared.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  void check_age();

  /// When its data will be too old if nothing new comes; the end of time if it has no age, or is
  /// too old already. Its component runs.
  /// @thread the component's own
  base::Time expiry() const;

  /// Until then its data is not too old, whatever comes; any past time if that is not known.
  /// @thread the component's own
  base::Time age_holds_until() const;

  /// A writer faulted: the reader's thread reacts as declared.
  /// @thread the writer's
  void tell_lost();

  /// Its component runs, and no ages have to be looked at, or not for some time.
  void set_at_once(bool on);

  /// The component starts: reactions to ages count from now.
  void begin();

  /// What was on its way to this port from another thread is gone with that thread.
  void forget_messages();

  /// The port's place in its array, from 0.
  std::size_t index() const { return index_; }
  void set_index(std::size_t index) { index_ = static_cast<std::uint32_t>(index); }

  std::string_view handler() const final { return name(); }
  const Entrance* outer() const final { return outer_; }

  // --- for the output port that is connected ---------------------------------------------------
  /// It reads `sample`, which the writer holds.
  void connect_source(OutputPortBase& writer, const void* sample);
  void connect_channel(OutputPortBase& writer, std::unique_ptr<internal::Channel> channel);
  /// Zeros in the shape of `value`: what is read before the first write.
  void set_shape(const void* value);
  /// Several writers will be connected, which take turns: one runs, the others do not. What the
  /// last one wrote stays until the next one writes.
  /// @thread configuration only, before they are connected
  void let_writers_take_turns();
  bool writers_take_turns() const;
  void disconnect(OutputPortBase& writer);
  /// A sample was written in this thread to the place that this port reads; for a component that
  /// calls out (see internal::Inside::call_out).
  /// @param where  the context of both
  void arrived(ExecutionContext& where) noexcept { arrived_(*this, where); }
  /// Takes what `channel` holds, one handler call for each sample.
  void drain(internal::Channel& channel);
  /// Runs the handler on a sample that came by `channel`.
  void receive(internal::Channel& channel, const void* sample);

  /// An input of the same name and type, whose values `owner` passes on; it keeps what this one is
  /// made of, which outlives it.
  /// @thread configuration only
  std::unique_ptr<InputPortBase> twin(StandIn& owner) const;
  /// An output of `owner` of the same type: for who writes this input from elsewhere. It keeps what
  /// this one is made of, which outlives it.
  /// @thread configuration only
  std::unique_ptr<OutputPortBase> make_writer(Component& owner, std::string_view name) const;

 protected:
  using Arrived = void (*)(InputPortBase&, ExecutionContext&) noexcept;
  using Handle = void (*)(InputPortBase&, const void* value);
  /// As `Reading`, of any type.
  struct Found {
    ReadStatus status;
    bool stale;
    const void* value;
    base::Time time;
  };

  InputPortBase(Component& owner, const PortDeclaration& declaration) noexcept;

  using PortBase::apply;
  void apply(MaxAge declared) noexcept;
  void apply(OnLost declared) noexcept;
  void apply(FanIn) noexcept;
  void apply(const LeadsTo& effects) noexcept;
  void apply(OnDataUpdate) noexcept;

  ReadStatus status_of(std::uint64_t sequence) {
    if (sequence == seen_) [[unlikely]]
      return ReadStatus::kOld;
    if (sequence != seen_ + 1) [[unlikely]]
      count_missed(sequence - seen_ - 1);
    seen_ = sequence;
    return ReadStatus::kNew;
  }
  /// Reads where there is more to it than a look at the sample.
  Found find() noexcept;
  /// Runs the handler where there is more to it than to call it.
  void arrived_with_care(ExecutionContext& where, Handle handle) noexcept;

  /// What makes a port less simple than most; all of it in one byte, so that one look tells.
  enum Special : std::uint8_t {
    kAges = 1,    ///< a maximum age is declared and has to be looked at
    kZeroed = 2,  ///< its writer was lost, and nothing came since
    kPulls = 4,   ///< a read takes from channels
    kRests = 8,   ///< its component does not run, or looks at ages first
  };
  bool is_special() const { return special_ != 0; }
  /// Its handler may run without a further look.
  bool is_simple() const { return (special_ | inside_) == 0; }

  const Entrance* outer_ = nullptr;
  bool triggers_ = false;
  std::uint8_t inside_ = 0;  ///< 1 while its handler runs

 private:
  struct About;
  struct Lost;
  class Twin;

  About& about() const;
  bool has(Special what) const { return (special_ & what) != 0; }
  void set(Special what, bool on) {
    special_ = static_cast<std::uint8_t>(on ? special_ | what : special_ & ~what);
  }
  void count_missed(std::uint64_t count);
  bool is_stale(base::Time written) const;
  bool reads_zero(bool stale) const;
  template <typename Code>
  void pass(ExecutionContext& where, Code&& code) noexcept;
  void react(Reaction reaction, std::string_view what);
  /// When the present data was written; waiting for the first counts from the start.
  base::Time written() const;
  bool has_running_writer() const;

  /// `writer` and its channels are no more.
  void forget_writer(OutputPortBase& writer);
  /// Takes the next sample of the channels, in turn; the channel it came from, or nullptr.
  internal::Channel* pull();
  /// Of writers that take turns only the newest sample counts.
  internal::Channel* pull_newest();
  void take(internal::Channel& channel, const void* sample);
  /// The next sample was taken from `channel`.
  void note_taken(internal::Channel& channel, std::uint64_t sequence);
  /// A FIFO's next sample is not passed over: it is the one to be read next.
  void look_for_newer();

  std::uint8_t special_ = kRests;
  std::uint32_t index_ = 0;

 protected:
  Arrived arrived_ = nullptr;  ///< runs the handler; made for each, so that it is one piece of code
  std::uint64_t seen_ = 0;
  const void* source_;  ///< the sample that is read
};

/// Option of an input port: a write runs `Handler`, a member function of the component that takes
/// nothing, the value, or the port's index in its array and the value. What arrives while the
/// component does not run triggers nothing, and can be read later.
template <auto Handler>
struct OnData {};
template <auto Handler>
inline constexpr OnData<Handler> on_data{};

/// Reads what is written to it, wait-free, from this thread or another.
template <typename T>
class InputPort final : private InputPortBase {
  static_assert(PortData<T>, ARMATURE_INTERNAL_PORT_DATA_TEXT);

 public:
  using InputPortBase::ages;
  using InputPortBase::connected;
  using InputPortBase::counters;
  using InputPortBase::max_age;
  using InputPortBase::name;
  using InputPortBase::operator new;
  using InputPortBase::operator delete;

  /// Name, documentation and unit are literals. Options: on_data<&X::f>, on_data_update, max_age,
  /// on_lost, may_stay_open, fan_in, size_of(property, factor), unit_of(property).
  template <typename... Options>
  InputPort(Component* owner, std::string_view name, std::string_view doc,
            std::string_view unit = {}, Options... options) noexcept
      : InputPort(*owner, name, doc, unit) {
    (apply(options), ...);
  }

  /// The newest value (of a FIFO: the next), and whether it is new, was read before, was never
  /// written, or can never come because nothing is connected.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  Reading<T> read() noexcept {
    const Sample<T>& newest = sample();
    if (is_special() || newest.sequence == 0) [[unlikely]]
      return read_with_care();
    const ReadStatus status = status_of(newest.sequence);
    return {status, false, newest.value, newest.time};
  }

 private:
  using RuntimeFace = InputPortBase;
  friend class internal::Inside;
  template <typename Port>
  friend class PortArray;
  InputPort(Component& owner, std::string_view name, std::string_view doc,
            std::string_view unit) noexcept
      : InputPortBase(owner, {name, doc, unit, types::type_of<T>(), internal::is_small<T>}) {}

  const Sample<T>& sample() const { return *static_cast<const Sample<T>*>(source_); }

  [[gnu::noinline]] Reading<T> read_with_care() noexcept {
    const Found found = find();
    return {found.status, found.stale, *static_cast<const T*>(found.value), found.time};
  }

  using InputPortBase::apply;
  template <auto Handler>
  void apply(OnData<Handler>) noexcept {
    triggers_ = true;
    arrived_ = [](InputPortBase& base, ExecutionContext& where) noexcept {
      auto& port = static_cast<InputPort&>(base);
      if (!port.is_simple()) [[unlikely]] {
        port.arrived_with_care(where, [](InputPortBase& self, const void* value) {
          call<Handler>(self.owner(), static_cast<InputPort&>(self), *static_cast<const T*>(value));
        });
        return;
      }
      Component& component = port.owner();
      port.inside_ = 1;
      internal::Inside::enter_handler(component, where, port, port.outer_,
                                      [&] { call<Handler>(component, port, port.sample().value); });
      port.inside_ = 0;
    };
  }

  template <auto Handler>
  static void call(Component& component, InputPort& port, const T& value) {
    using Owner = internal::OwnerOf<Handler>;
    auto& owner = static_cast<Owner&>(component);
    if constexpr (std::is_invocable_v<decltype(Handler), Owner&>) {
      (owner.*Handler)();
    } else {
      port.seen_ = port.sample().sequence;
      if constexpr (std::is_invocable_v<decltype(Handler), Owner&, const T&>) {
        (owner.*Handler)(value);
      } else {
        static_assert(std::is_invocable_v<decltype(Handler), Owner&, std::size_t, const T&>,
                      "a handler of an input port takes (), (value) or (index, value)");
        (owner.*Handler)(port.index(), value);
      }
    }
  }
};

// Compiled once, in the library.
extern template class InputPort<bool>;
extern template class InputPort<int>;
extern template class InputPort<double>;
extern template class InputPort<std::vector<double>>;

}  // namespace armature::component
