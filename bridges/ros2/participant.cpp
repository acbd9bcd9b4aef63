// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/participant.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>

#include "bridges/ros2/internal/dds.hpp"
#include "bridges/ros2/internal/dds_log.hpp"
#include "bridges/ros2/internal/loopback_sockets.hpp"

namespace armature::ros2 {
namespace {

using internal::QosPtr;

/// How many participants of this machine are asked where no multicast asks them.
constexpr int kMostOnOneMachine = 32;
/// How often it says that it is there. Who asks by multicast, as ROS 2 does under
/// ROS_LOCALHOST_ONLY, finds a node without multicast by this only.
constexpr const char* kSaysSoEach = "1 s";

bool is_word(std::string_view text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) == 0 &&
         std::ranges::all_of(
             text, [](unsigned char each) { return std::isalnum(each) != 0 || each == '_'; });
}

/// `a`, `a/b`
bool is_path(std::string_view text) {
  while (true) {
    const auto slash = text.find('/');
    if (!is_word(text.substr(0, slash))) return false;
    if (slash == std::string_view::npos) return true;
    text.remove_prefix(slash + 1);
  }
}

/// Nothing that could be read as markup.
bool is_address(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char each) {
    return std::isalnum(each) != 0 ||
           std::string_view("._:-%").find(static_cast<char>(each)) != std::string_view::npos;
  });
}

std::string wrong_with(const Network& network) {
  if (!is_word(network.node)) {
    return "the node's name '" + network.node + "' must have letters, digits and _ only";
  }
  const std::string_view space = network.name_space;
  if (space != "/" && !(space.starts_with('/') && is_path(space.substr(1)))) {
    return "the namespace '" + network.name_space + "' must be / or like /arm/left";
  }
  if (!is_address(network.interface)) {
    return "the interface '" + network.interface + "' must be a name or address, such as lo";
  }
  for (const std::string& peer : network.peers) {
    if (!is_address(peer)) return "the peer '" + peer + "' must be an address, such as 127.0.0.1";
  }
  return {};
}

/// What Cyclone DDS is told. The threads' stacks are small: they may be locked in memory.
std::string configuration_of(const Network& network) {
  const bool is_number = network.interface.find_first_of(".:") != std::string::npos;
  const bool asks_everybody = network.peers.empty() && !is_loopback(network.interface);
  std::vector<std::string> peers = network.peers;
  if (peers.empty() && !asks_everybody) peers = {"127.0.0.1"};
  std::string text = "<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface ";
  text += (is_number ? "address=\"" : "name=\"") + network.interface + "\"";
  text += std::string(" multicast=\"") + (asks_everybody ? "true" : "false") + "\"/></Interfaces>";
  text += std::string("<AllowMulticast>") + (asks_everybody ? "true" : "false") +
          "</AllowMulticast></General>";
  text += "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>" +
          std::to_string(kMostOnOneMachine) + "</MaxAutoParticipantIndex><SPDPInterval>" +
          kSaysSoEach + "</SPDPInterval><Peers>";
  for (const std::string& peer : peers) text += "<Peer address=\"" + peer + "\"/>";
  text += std::string("</Peers></Discovery><Internal><MaxSampleSize>") +
          std::to_string(kLargestSample) + " B</MaxSampleSize></Internal><Threads>";
  for (const char* name : {"recv", "tev", "gc", "lease", "dq.builtins", "dq.user"}) {
    text += std::string("<Thread name=\"") + name + "\"><StackSize>256 kB</StackSize></Thread>";
  }
  return text + "</Threads></Domain></CycloneDDS>";
}

/// The name on DDS of a topic of ROS 2; empty if it is none.
std::string dds_name_of(const std::string& topic, const std::string& name_space) {
  if (topic.starts_with('/')) return is_path(topic.substr(1)) ? "rt" + topic : "";
  if (!is_path(topic)) return {};
  return "rt" + name_space + (name_space == "/" ? "" : "/") + topic;
}

QosPtr qos_of(const Quality& quality) {
  QosPtr qos(dds_create_qos());
  // Nobody waits for a reader that is late: its samples are lost, and counted.
  dds_qset_reliability(
      qos.get(), quality.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos.get(), quality.transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL
                                                         : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, quality.depth);
  return qos;
}

std::string why(dds_return_t code) { return dds_strretcode(code); }

}  // namespace

bool is_loopback(std::string_view interface) {
  return interface == "lo" || interface.starts_with("127.") || interface == "::1";
}

Writer::~Writer() { participant_->remove(entity_); }

bool Writer::write(const void* sample) { return dds_write(entity_, sample) == DDS_RETCODE_OK; }

Reader::~Reader() { participant_->remove(entity_); }

/// Of the senders, who came and who went.
void Reader::look_around() {
  std::vector<dds_instance_handle_t> handles(2 * senders_.size() + 8);
  while (true) {
    const dds_return_t count =
        dds_get_matched_publications(entity_, handles.data(), handles.size());
    if (count < 0) return;
    const bool all = static_cast<std::size_t>(count) <= handles.size();
    handles.resize(static_cast<std::size_t>(count));
    if (all) break;
  }
  std::map<std::uint64_t, Sender> present;
  for (const dds_instance_handle_t handle : handles) {
    if (const auto known = senders_.find(handle); known != senders_.end()) {
      present.insert(*known);
    } else if (auto* const found = dds_get_matched_publication_data(entity_, handle)) {
      std::ranges::copy(found->key.v, present[handle].begin());
      dds_builtintopic_free_endpoint(found);
    }
  }
  senders_ = std::move(present);
}

std::vector<Sender> Reader::senders() {
  look_around();
  std::vector<Sender> all;
  for (const auto& [handle, sender] : senders_) all.push_back(sender);
  return all;
}

void Reader::take(std::size_t most, const std::function<void(const void*, const Sender*)>& see) {
  // Who has gone since the last time may have left something.
  const std::map<std::uint64_t, Sender> before = senders_;
  look_around();
  senders_.insert(before.begin(), before.end());
  constexpr std::size_t kPiece = 16;
  while (most > 0) {
    std::array<void*, kPiece> samples{};
    std::array<dds_sample_info_t, kPiece> infos;
    const std::size_t room = std::min(most, kPiece);
    const dds_return_t found =
        dds_take(entity_, samples.data(), infos.data(), room, static_cast<std::uint32_t>(room));
    if (found <= 0) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(found); ++i) {
      if (!infos[i].valid_data) continue;
      const auto sender = senders_.find(infos[i].publication_handle);
      see(samples[i], sender == senders_.end() ? nullptr : &sender->second);
    }
    dds_return_loan(entity_, samples.data(), found);
    most -= static_cast<std::size_t>(found);
  }
}

base::Result<std::shared_ptr<Participant>> Participant::open(const Network& network) {
  if (std::string wrong = wrong_with(network); !wrong.empty()) return base::Error{wrong};
  internal::count_dds_log();
  const auto id = static_cast<dds_domainid_t>(network.domain);
  const dds_entity_t domain = dds_create_domain(id, configuration_of(network).c_str());
  if (domain == DDS_RETCODE_PRECONDITION_NOT_MET) {
    return base::Error{"domain " + std::to_string(network.domain) +
                       " is in use by this process already: an application has one node"};
  }
  if (domain < 0) {
    return base::Error{"DDS cannot begin on the interface '" + network.interface +
                       "': " + why(domain) + ", " + internal::take_dds_log().last +
                       " (ip link shows the interfaces)"};
  }
  if (is_loopback(network.interface)) {
    // Before there is a participant: what came so far was for nobody.
    if (std::string wrong = internal::keep_on_loopback(network.domain); !wrong.empty()) {
      dds_delete(domain);
      return base::Error{wrong};
    }
  }
  const QosPtr qos(dds_create_qos());
  // By this ROS 2 takes a participant for one of its own.
  constexpr std::string_view kEnclave = "enclave=/;";
  dds_qset_userdata(qos.get(), kEnclave.data(), kEnclave.size());
  const dds_entity_t entity = dds_create_participant(id, qos.get(), nullptr);
  if (entity < 0) {
    dds_delete(domain);
    return base::Error{"DDS has no participant for the domain " + std::to_string(network.domain) +
                       ": " + why(entity) + " (" + std::to_string(kMostOnOneMachine) +
                       " at most on one machine)"};
  }
  std::shared_ptr<Participant> made(new Participant(network, domain, entity));
  const dds_topic_descriptor& type = rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc;
  const dds_entity_t topic =
      dds_create_topic(entity, &type, "ros_discovery_info", nullptr, nullptr);
  const QosPtr kept = qos_of({.transient_local = true, .depth = 1});
  made->announcer_ = topic < 0 ? topic : dds_create_writer(entity, topic, kept.get(), nullptr);
  if (made->announcer_ < 0) {
    return base::Error{"DDS cannot announce the node: " + why(made->announcer_)};
  }
  made->announce();
  return made;
}

Participant::~Participant() {
  dds_delete(entity_);
  dds_delete(domain_);
}

base::Result<std::int32_t> Participant::topic_of(const std::string& name,
                                                 const dds_topic_descriptor& type) {
  const std::string full = dds_name_of(name, network_.name_space);
  if (full.empty()) {
    return base::Error{"the topic '" + name +
                       "' must be like joint_states or /arm/joint_states: letters, digits and _"};
  }
  const dds_entity_t topic = dds_create_topic(entity_, &type, full.c_str(), nullptr, nullptr);
  if (topic < 0) return base::Error{"DDS refuses the topic '" + name + "': " + why(topic)};
  return topic;
}

base::Result<std::unique_ptr<Writer>> Participant::write_to(const std::string& topic,
                                                            const dds_topic_descriptor& type,
                                                            const Quality& quality) {
  const auto on = topic_of(topic, type);
  if (!on) return base::Error{on.error()};
  const dds_entity_t made = dds_create_writer(entity_, on.value(), qos_of(quality).get(), nullptr);
  if (made < 0) return base::Error{"DDS has no writer for '" + topic + "': " + why(made)};
  add(made, true);
  return std::make_unique<Writer>(shared_from_this(), made);
}

base::Result<std::unique_ptr<Reader>> Participant::read_from(const std::string& topic,
                                                             const dds_topic_descriptor& type,
                                                             const Quality& quality) {
  const auto on = topic_of(topic, type);
  if (!on) return base::Error{on.error()};
  const dds_entity_t made = dds_create_reader(entity_, on.value(), qos_of(quality).get(), nullptr);
  if (made < 0) return base::Error{"DDS has no reader for '" + topic + "': " + why(made)};
  add(made, false);
  return std::make_unique<Reader>(shared_from_this(), made);
}

void Participant::add(std::int32_t entity, bool writes) {
  endpoints_.push_back({entity, writes});
  announce();
}

void Participant::remove(std::int32_t entity) {
  dds_delete(entity);
  std::erase_if(endpoints_, [&](const Endpoint& each) { return each.entity == entity; });
  announce();
}

/// Tells what of the participant is this node's, as rmw_dds_common has it.
void Participant::announce() {
  const auto gid_of = [](std::int32_t entity) {
    rmw_dds_common_msg_dds__Gid_ gid{};
    dds_guid_t guid{};
    if (dds_get_guid(entity, &guid) == DDS_RETCODE_OK) std::memcpy(gid.data, guid.v, sizeof guid.v);
    return gid;
  };
  std::vector<rmw_dds_common_msg_dds__Gid_> readers;
  std::vector<rmw_dds_common_msg_dds__Gid_> writers;
  for (const Endpoint& each : endpoints_) {
    (each.writes ? writers : readers).push_back(gid_of(each.entity));
  }
  rmw_dds_common_msg_dds__NodeEntitiesInfo_ node{};
  network_.name_space.copy(node.node_namespace, sizeof node.node_namespace - 1);
  network_.node.copy(node.node_name, sizeof node.node_name - 1);
  internal::lend(readers, node.reader_gid_seq);
  internal::lend(writers, node.writer_gid_seq);
  rmw_dds_common_msg_dds__ParticipantEntitiesInfo_ info{};
  info.gid = gid_of(entity_);
  info.node_entities_info_seq._length = info.node_entities_info_seq._maximum = 1;
  info.node_entities_info_seq._buffer = &node;
  dds_write(announcer_, &info);
}

}  // namespace armature::ros2
