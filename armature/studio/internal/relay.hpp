// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/ride/node.hpp"
#include "armature/ride/placeholder.hpp"
#include "armature/ride/service.hpp"
#include "armature/studio/internal/begun_commands.hpp"
#include "armature/studio/internal/operators_acts.hpp"
#include "armature/studio/internal/seat.hpp"
#include "armature/studio/internal/watch_union.hpp"

namespace armature::studio::internal {

/// The inspector of a run, for pages: what they ask of it is handed on, and its answers back. The
/// run takes the studio for its user, so what a page may do is looked at here. Of what is called,
/// begun or written the names are looked at: an act of the operator is handed on from the
/// operator's seat only, operations and commands while the key is held; what the run has not
/// described is not handed on. What pages watch is one watch of the run. The rest passes unseen.
class Relay final : public ride::Service {
 public:
  /// So many requests of one client, and of all together, wait for the run's answers: fewer than
  /// it takes, so that there is always room for an emergency stop.
  static constexpr std::size_t kMostOfOne = 16;
  static constexpr std::size_t kMostOfAll = 40;

  /// @param name  as which pages know it, also in policies
  /// @param wake  called by any thread when `learn` has something to do
  Relay(std::string name, Seat& seat, std::function<void()> wake);

  /// From now on it is the one at this address.
  /// @thread any but the node's own, as for those below
  void connect(const std::string& address);
  /// Likewise the one of a peer, which outlives the connection.
  void connect(ride::Peer& peer);
  /// There is none.
  void disconnect();
  /// There is one; it has been found, and has described its components.
  bool ready() const;
  /// Asks for descriptions that are missing, and for what pages watch: after each answer, and now
  /// and then.
  void learn();
  /// Cancels the commands, and ends the watches, of those who have gone. Some ten times a second.
  void cancel_lost(base::Time now);

  /// Told whether an operation was done, and why not.
  using Done = std::function<void(const base::Result<void>&)>;
  /// The components that everybody may disarm; nothing while there may be more.
  /// @thread any
  std::optional<std::vector<std::string>> to_disarm() const;
  /// Disarms one of them, before all that others have asked for.
  /// @thread any
  void disarm(const std::string& component, Done done);

 private:
  /// Asks with bodies that somebody else has encoded.
  class Inspector final : public ride::Placeholder {
   public:
    using Placeholder::ask;
    using Placeholder::Placeholder;
  };
  /// What answers of a run, which come at any time, leave.
  struct Learned {
    std::mutex mutex;  ///< of the next
    OperatorsActs acts;
    std::size_t asked = 0;              ///< descriptions that are under way
    std::vector<ride::Origin> waiting;  ///< who waits for answers, an entry for each request
    std::atomic<int> followed{0};       ///< commands whose states are asked for
    BegunCommands begun;                ///< has a mutex of its own
  };
  /// A run, as long as it can be asked.
  struct Connection final : WatchedRun {
    Connection(std::unique_ptr<ride::Node> own_node, ride::Peer& peer,
               const std::function<void()>& wake);
    void watch(const std::vector<std::string>& items, double interval,
               Told<remote::Watch> told) override;
    void watched(std::int32_t handle, Told<remote::WatchedValues> told) override;
    void end_watch(std::int32_t handle) override;

    const std::shared_ptr<Learned> learned = std::make_shared<Learned>();
    const std::shared_ptr<WatchUnion> watches;
    const std::unique_ptr<ride::Node> node;  ///< none: the peer is of somebody else's
    Inspector inspector;
  };

  ride::Executed execute(ride::Number operation, ride::Decoder& parameters,
                         ride::Reply& reply) override;
  void take(std::shared_ptr<Connection> made);
  std::shared_ptr<Connection> connection() const;
  static bool serve_watch(Connection& run, std::string_view operation,
                          std::span<const std::byte> body, ride::Reply& reply);
  bool may_pass(Learned& learned, std::string_view operation, std::span<const std::byte> body,
                const ride::Origin& origin);
  void demand_seat(const std::string& what, const ride::Origin& origin);
  void let_through(Act act, const std::string& what, bool with_key, const ride::Origin& origin);
  static void ask_about(Connection& run, std::string_view operation, std::int32_t handle,
                        ride::Priority priority,
                        std::function<void(const std::optional<remote::CommandStatus>&)> told);
  static void leave(Learned& learned, const ride::Origin& origin);
  static void take_begun(Learned& learned, std::span<const std::byte> result,
                         const ride::Origin& origin);
  static void ask_for(Connection& run, const std::function<void()>& wake,
                      std::string_view operation, const ride::Fields& parameters,
                      std::function<bool(ride::Decoder&, OperatorsActs&)> take);

  const std::string name_;
  Seat& seat_;
  const std::function<void()> wake_;
  mutable std::mutex mutex_;  ///< of the next
  std::shared_ptr<Connection> connection_;
};

}  // namespace armature::studio::internal
