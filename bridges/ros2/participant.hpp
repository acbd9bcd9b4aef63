// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"

struct dds_topic_descriptor;  // of Cyclone DDS

namespace armature::ros2 {

/// Bytes of a message in either direction; a reader keeps some hundred.
inline constexpr std::size_t kLargestSample = 4u << 20;

/// Where a node is in the world of ROS 2, and how it finds others.
struct Network {
  std::string node = "armature";     ///< its name: letters, digits and _
  std::string name_space = "/";      ///< `/`, `/arm`, `/arm/left`
  int domain = 0;                    ///< ROS_DOMAIN_ID
  std::string interface = "lo";      ///< name or address of the network interface
  std::vector<std::string> peers{};  ///< addresses that are asked; none: multicast asks everybody
};

/// Whether only this machine is behind `interface`.
bool is_loopback(std::string_view interface);

/// What a topic promises, as ROS 2 calls it.
struct Quality {
  bool reliable = true;
  bool transient_local = false;  ///< who comes later is given the last samples
  int depth = 10;                ///< samples that are kept for a late reader
};

class Participant;

/// Puts samples on a topic.
/// @thread one at a time, none of them real-time: it allocates and may wait
class Writer {
 public:
  Writer(std::shared_ptr<Participant> participant, std::int32_t entity)
      : participant_(std::move(participant)), entity_(entity) {}
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer();

  /// @param sample  of the C type that Cyclone's idlc made of the topic's type
  /// @return false if DDS did not take it: readers are too late for what is kept for them
  bool write(const void* sample);

 private:
  std::shared_ptr<Participant> participant_;
  std::int32_t entity_;
};

/// Who writes samples, on the whole network and for all time (its GUID): a program that begins anew
/// is another one.
using Sender = std::array<std::uint8_t, 16>;

/// Takes samples from a topic.
/// @thread as Writer
class Reader {
 public:
  Reader(std::shared_ptr<Participant> participant, std::int32_t entity)
      : participant_(std::move(participant)), entity_(entity) {}
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader();

  /// Shows `see` each sample that has come, oldest first, `most` at most.
  /// @param see  `sender` is nullptr if it was not there long enough to be known
  void take(std::size_t most,
            const std::function<void(const void* sample, const Sender* sender)>& see);
  /// Who is there now, whether it has sent anything or not.
  std::vector<Sender> senders();

 private:
  void look_around();

  std::shared_ptr<Participant> participant_;
  std::int32_t entity_;
  std::map<std::uint64_t, Sender> senders_;  ///< by the handle that DDS has of it here
};

/// One participant of DDS, which is one node of ROS 2: it is announced with all that it reads and
/// writes, as rmw_dds_common has it, so that `ros2 node list` and `ros2 topic info -v` show it.
/// @thread as Writer
class Participant : public std::enable_shared_from_this<Participant> {
 public:
  /// An error says what of `network` is wrong, or why DDS cannot begin.
  static base::Result<std::shared_ptr<Participant>> open(const Network& network);
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;
  ~Participant();

  /// @param topic  as ROS 2 has it: `joint_states` is below the node's namespace, `/tf` is not
  /// @param type   lives as long as the writer
  /// @return the error names the topic
  base::Result<std::unique_ptr<Writer>> write_to(const std::string& topic,
                                                 const dds_topic_descriptor& type,
                                                 const Quality& quality);
  base::Result<std::unique_ptr<Reader>> read_from(const std::string& topic,
                                                  const dds_topic_descriptor& type,
                                                  const Quality& quality);

 private:
  friend class Writer;
  friend class Reader;
  /// A reader or writer, as others know it.
  struct Endpoint {
    std::int32_t entity;
    bool writes;
  };
  Participant(Network network, std::int32_t domain, std::int32_t entity)
      : network_(std::move(network)), domain_(domain), entity_(entity) {}

  base::Result<std::int32_t> topic_of(const std::string& name, const dds_topic_descriptor& type);
  void add(std::int32_t entity, bool writes);
  void remove(std::int32_t entity);
  void announce();

  Network network_;
  std::int32_t domain_;
  std::int32_t entity_;
  std::int32_t announcer_ = 0;  ///< the writer of ros_discovery_info
  std::vector<Endpoint> endpoints_;
};

}  // namespace armature::ros2
