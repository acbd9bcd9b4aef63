// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"
#include "robots/wam/driver/board_watch.hpp"
#include "robots/wam/driver/puck_watch.hpp"
#include "robots/wam/driver/wam_record.hpp"
#include "robots/wam/protocol/puck_protocol.hpp"
#include "robots/wam/protocol/puck_torque.hpp"

namespace armature::wam {

/// How a reading of all positions stands.
enum class WamReading {
  kNone,        ///< none was begun
  kWaiting,     ///< for answers: poll again when a frame has come, or at the deadline
  kComplete,    ///< all pucks have answered
  kIncomplete,  ///< some have not; `WamMotor::fresh` says which have
  kNoBus,       ///< the bus is off or down
};

/// Why no torque is sent any more, until `acknowledge` or `start`.
enum class WamFault : std::uint8_t {
  kNone,
  kNoBus,         ///< the bus was off or down
  kPuckSilent,    ///< a puck has not answered for too many cycles; see `fault_node`
  kPowerCut,      ///< such a puck stayed silent, and `cut_power` has led to E-stop
  kPositionJump,  ///< a puck told positions that cannot be; its zero is lost
  kBoardSilent,   ///< the safety board has not answered
  kEstop,         ///< E-stop: the pucks have lost power and their positions
  kIdled,     ///< the board went from active to idle; the operator did it, or it does not say why
  kVelocity,  ///< the board went to idle because of what it supervises
  kTorque,
  kVoltage,
  kHeartbeat,
  kOther,
};
const char* to_text(WamFault fault);
/// Where a fault is of all pucks alike.
constexpr int kEveryNode = -1;
/// Positions are not to be believed after it: the arm has to be put at home.
bool loses_positions(WamFault fault);

/// What became of a torque that was set.
enum class WamTorque {
  kTaken,
  kLimited,    ///< to what the puck says is most
  kNotFinite,  ///< 0 instead
};

/// What went wrong with one motor's puck; nothing is lost without being counted here.
struct WamCounters {
  std::uint64_t missed = 0;      ///< requests without an answer in time
  std::uint64_t late = 0;        ///< positions that came when none was waited for; not used
  std::uint64_t jumps = 0;       ///< positions too far from the last; not used
  std::uint64_t malformed = 0;   ///< frames of a wrong length
  std::uint64_t limited = 0;     ///< torques beyond the puck's most
  std::uint64_t not_finite = 0;  ///< torques that were no numbers
  std::uint64_t stale = 0;       ///< torque frames with 0, since nobody had set the torque anew

  friend bool operator==(const WamCounters&, const WamCounters&) = default;
};

/// What is known of one motor.
struct WamMotor {
  int node = 0;
  std::int32_t counts = 0;  ///< the last position that was good
  /// [rad] of the motor's shaft, in the middle between this count and the next.
  double position = 0.0;
  base::Time position_time{};
  bool known = false;                        ///< there was a position
  bool fresh = false;                        ///< it is of the reading that was begun last
  int cycles_without = 0;                    ///< readings since then
  std::optional<std::int32_t> joint_counts;  ///< of the joint's encoder, if the puck told it
  WamCounters counters;
};

/// What concerns no motor.
struct WamBusCounters {
  std::uint64_t unknown_frames = 0;  ///< that no device of the arm sends to the host
  std::uint64_t error_frames = 0;
  std::uint64_t not_sent = 0;  ///< frames that the bus did not take
  std::uint64_t bus_lost = 0;  ///< how often the bus was found to be off or down

  friend bool operator==(const WamBusCounters&, const WamBusCounters&) = default;
};

/// The host's side of a WAM's cycle, for an arm that `WamStartup` has got ready:
///
///     driver.begin_reading(now);
///     while (driver.poll(now) == WamReading::kWaiting) { /* sleep until news or the deadline */ }
///     driver.set_torque(0, 0.1, now);
///     driver.send_torques(now);
///
/// 500 times a second, from the first cycle on, so that the safety board always hears its
/// heartbeat: torques are 0 unless the board is active and there is no fault. Motors are numbered
/// from 0; angles and torques are those of their own shafts. The driver neither opens nor closes
/// the bus, and never asks for more than the board allows.
///
/// A puck that did not answer is left out of the next request: what still comes from it then is the
/// late answer, and never taken for that to another request.
///
/// Every function but `make` and `bus_options` is nonblocking and allocates nothing. One thread
/// uses the driver; it is the bus's sender and receiver.
class WamDriver {
 public:
  struct Config {
    /// How long to wait for all positions, from their request; > 0. The frames take 0.85 ms.
    base::Duration reply_timeout = std::chrono::microseconds(1400);
    /// Readings without a puck's position, from which on it is silent; >= 1.
    int most_without = 3;
    /// A torque that was not set anew for so long is 0; > 0.
    base::Duration torque_timeout = std::chrono::milliseconds(10);
    /// How often the board is asked for each of MODE and PEN; >= 50 ms.
    base::Duration watch_period = std::chrono::milliseconds(50);
  };

  /// @param bus  outlives the driver
  /// An error names what is wrong in the configuration, or that the arm is not ready.
  static base::Result<WamDriver> make(can::Bus& bus, const WamRecord& arm, const Config& config);
  /// How to open a bus for an arm: what is sent to the host, and nothing else.
  static can::BusOptions bus_options();

  /// Begins anew: no fault, no position, all torques 0.
  void start(base::Time now);
  /// Takes what came since the last reading, which is given up if it still waits; then asks for all
  /// positions, and the board for its mode when that is due. Asks a bus that is off to come back.
  /// @return kWaiting; kNoBus; kIncomplete if there was nobody to ask
  WamReading begin_reading(base::Time now);
  /// Takes what has come, and gives up at the deadline.
  WamReading poll(base::Time now);
  WamReading reading() const { return reading_; }
  base::Time deadline() const { return deadline_; }

  /// For `send_torques`, until it is set anew or `torque_timeout` has passed; as a PuckTorque.
  /// @param torque  [Nm]
  WamTorque set_torque(std::size_t motor, double torque, base::Time now);
  /// A frame for motors 1 to 4, and one for 5 to 7.
  /// @return kSent, or why the first frame was not taken that was not
  can::SendStatus send_torques(base::Time now);
  /// Asks a puck for what it tells of its own state, if that is due; after the cycle's torques,
  /// where the bus has half a millisecond left until the next cycle. Nothing is asked while there
  /// is a fault.
  void ask_puck(base::Time now);
  /// @param config  from the next question on
  void watch_pucks(base::Time now, const PuckWatch::Config& config) { pucks_.start(now, config); }
  const PuckWatch& pucks() const { return pucks_; }
  /// Sets all pucks idle at once, which brakes their motors; the board does not notice.
  /// @return as `send_torques`
  can::SendStatus send_idle();

  /// Torques are obeyed: the board is active, and there is no fault.
  bool active() const { return fault_ == WamFault::kNone && watch_.mode() == BoardMode::kActive; }
  /// A puck is silent now, whatever the fault is.
  bool any_silent() const;
  /// After kPuckSilent: one is silent still, and the board has answered since, so it is not the
  /// bus. Such a puck may hear nobody, and its motor goes on as it was told last.
  bool needs_power_cut() const { return board_heard_ && any_silent(); }
  /// Asks the board for E-stop, which ends that. The fault becomes kPowerCut when the board says
  /// that it has done so; boards with firmware below 197 do not.
  /// @return as `send_torques`
  can::SendStatus cut_power(base::Time now);

  /// As the board said last; none before it did.
  std::optional<BoardMode> board_mode() const { return watch_.mode(); }
  /// When it said so.
  base::Time board_mode_time() const { return watch_.mode_time(); }
  /// What the pendant shows; none before the board told, or if its firmware tells something else.
  std::optional<PendantWord> pendant() const { return watch_.pendant(); }
  /// The first since `start` or `acknowledge`, except that kPositionJump replaces it, kEstop and
  /// kPowerCut replace any other, and kIdled becomes what the board names within 100 ms.
  WamFault fault() const { return fault_; }
  /// The puck of kPuckSilent, kPowerCut and kPositionJump, or kEveryNode; else 0.
  int fault_node() const { return fault_node_; }
  /// Ends a fault, as an act of the operator; all torques are 0.
  /// @return false for what loses positions, which needs `WamStartup` and `start`
  bool acknowledge();

  std::size_t motors() const { return arm_.motors; }
  const WamMotor& motor(std::size_t motor) const { return motors_[motor]; }
  const WamRecord& arm() const { return arm_; }
  const WamBusCounters& bus_counters() const { return bus_counters_; }
  const BoardWatch::Counters& watch_counters() const { return watch_.counters(); }
  can::BusState bus_state() const { return bus_->state(); }

 private:
  /// What the driver keeps of a motor for itself.
  struct Account {
    bool asked = false;     ///< in this reading
    bool owes = false;      ///< did not answer when it was asked last
    bool jumped = false;    ///< in this reading
    bool doubtful = false;  ///< it jumped, and has told no good position since
    PuckTorque torque;
    base::Time torque_time = base::Time::min();
  };

  WamDriver(can::Bus& bus, const WamRecord& arm, const Config& config);

  bool bus_was_lost() const;
  WamReading lose_bus();
  void ask_positions(base::Time now);
  void ask_board(base::Time now);
  bool nobody_asked() const;
  bool all_answered() const;
  void finish(base::Time now);

  // wam_driver_safety.cpp
  bool silent(std::size_t motor) const {
    return motors_[motor].cycles_without >= config_.most_without;
  }
  void judge_silence(std::size_t motor, base::Time now);
  void judge_board(base::Time now);
  void judge_drop(BoardMode before, base::Time now);
  void name_drop(base::Time now);
  void raise(WamFault fault, int node = 0);

  void take_frames(base::Time now);
  void take(const can::Arrival& arrival, base::Time now);
  void take_position(std::size_t motor, const can::Arrival& arrival);

  void clear_torques();
  std::int16_t torque_to_send(std::size_t motor, base::Time now);
  can::SendStatus send(const can::Frame& frame);

  can::Bus* bus_;
  WamRecord arm_;
  Config config_;
  BoardWatch watch_;
  PuckWatch pucks_;
  std::array<WamMotor, kMostMotors> motors_{};
  std::array<Account, kMostMotors> accounts_{};

  WamReading reading_ = WamReading::kNone;
  base::Time deadline_ = base::Time::max();
  std::uint64_t bus_offs_seen_ = 0;
  std::optional<BoardMode> mode_seen_;
  std::uint64_t pendants_seen_ = 0;
  WamFault fault_ = WamFault::kNone;
  int fault_node_ = 0;
  bool cuts_power_ = false;
  bool board_heard_ = false;  ///< since a puck was found to be silent
  WamBusCounters bus_counters_;
};

}  // namespace armature::wam
