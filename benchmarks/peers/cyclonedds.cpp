// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <stdexcept>

#include <dds/dds.h>

#include "benchmarks/peers/peer.hpp"
#include "dds_wheels.h"

namespace armature::benchmarks::peers {
namespace {

constexpr dds_domainid_t kDomain = 42;
/// Loopback and one peer: nothing is sent to anyone else.
constexpr const char* kConfiguration = R"(
<General>
  <Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>
  <AllowMulticast>false</AllowMulticast>
</General>
<Discovery>
  <ParticipantIndex>auto</ParticipantIndex>
  <Peers><Peer address="127.0.0.1"/></Peers>
</Discovery>)";

dds_entity_t check(dds_entity_t entity) {
  if (entity < 0) throw std::runtime_error(std::string("Cyclone DDS: ") + dds_strretcode(-entity));
  return entity;
}

/// One side of the conversation: reliable, all samples kept until they are taken.
class Side {
 public:
  Side() {
    check(dds_create_domain(kDomain, kConfiguration));
    participant_ = check(dds_create_participant(kDomain, nullptr, nullptr));
    qos_ = dds_create_qos();
    dds_qset_reliability(qos_, DDS_RELIABILITY_RELIABLE, DDS_SECS(60));
    dds_qset_history(qos_, DDS_HISTORY_KEEP_ALL, 0);
  }
  Side(const Side&) = delete;
  Side& operator=(const Side&) = delete;
  ~Side() {
    dds_delete_qos(qos_);
    dds_delete(DDS_CYCLONEDDS_HANDLE);
  }

  dds_entity_t topic(const dds_topic_descriptor_t& type, const char* name) {
    return check(dds_create_topic(participant_, &type, name, nullptr, nullptr));
  }
  dds_entity_t reader(dds_entity_t topic, const dds_listener_t* listener = nullptr) {
    return check(dds_create_reader(participant_, topic, qos_, listener));
  }
  dds_entity_t writer(dds_entity_t topic) {
    return check(dds_create_writer(participant_, topic, qos_, nullptr));
  }
  dds_entity_t participant() const { return participant_; }

 private:
  dds_entity_t participant_ = 0;
  dds_qos_t* qos_ = nullptr;
};

/// Calls `use` for each sample that is there.
template <typename Sample, typename Use>
void take(dds_entity_t reader, const Use& use) {
  std::array<void*, 256> samples{};
  std::array<dds_sample_info_t, 256> infos{};
  for (;;) {
    const int count = dds_take(reader, samples.data(), infos.data(), samples.size(),
                               static_cast<std::uint32_t>(samples.size()));
    if (check(count) == 0) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (infos[i].valid_data) use(*static_cast<const Sample*>(samples[i]));
    }
    dds_return_loan(reader, samples.data(), count);
  }
}

/// Answers in the thread that receives.
class CycloneServer final : public Server {
 public:
  CycloneServer() {
    replies_ = side_.writer(side_.topic(cyclone_Reply_desc, "replies"));
    listen(side_.topic(cyclone_Request_desc, "requests"), [](dds_entity_t reader, void* server) {
      take<cyclone_Request>(reader, [&](const cyclone_Request& request) {
        const auto value = peers::set_velocity(request.left, request.right);
        if (request.answered) static_cast<CycloneServer*>(server)->answer(value);
      });
    });
    listen(side_.topic(cyclone_LargeRequest_desc, "large_requests"),
           [](dds_entity_t reader, void* server) {
             take<cyclone_LargeRequest>(reader, [&](const cyclone_LargeRequest& request) {
               const auto value = peers::set_all(request.velocities._length);
               static_cast<CycloneServer*>(server)->answer(value);
             });
           });
  }
  std::string address() const override { return "found by discovery"; }

 private:
  void listen(dds_entity_t topic, dds_on_data_available_fn handler) {
    dds_listener_t* const listener = dds_create_listener(this);
    dds_lset_data_available(listener, handler);
    side_.reader(topic, listener);
    dds_delete_listener(listener);
  }
  void answer(std::int32_t value) {
    const cyclone_Reply reply{value};
    check(dds_write(replies_, &reply));
  }

  Side side_;
  dds_entity_t replies_ = 0;
};

class CycloneClient final : public Client {
 public:
  CycloneClient() {
    const dds_entity_t topic = side_.topic(cyclone_Request_desc, "requests");
    requests_ = side_.writer(topic);
    large_requests_ = side_.writer(side_.topic(cyclone_LargeRequest_desc, "large_requests"));
    dds_write_set_batch(true);
    gathered_requests_ = side_.writer(topic);
    dds_write_set_batch(false);
    replies_ = side_.reader(side_.topic(cyclone_Reply_desc, "replies"));
    there_ = check(dds_create_readcondition(replies_, DDS_ANY_STATE));
    waits_ = check(dds_create_waitset(side_.participant()));
    check(dds_waitset_attach(waits_, there_, 0));
    wait_for_server();
  }
  std::int32_t set_velocity(float left, float right) override {
    const cyclone_Request request{true, left, right};
    check(dds_write(requests_, &request));
    return answer();
  }
  std::int32_t set_all(const std::vector<double>& all) override {
    cyclone_LargeRequest request{};
    request.velocities._length = static_cast<std::uint32_t>(all.size());
    request.velocities._maximum = request.velocities._length;
    request.velocities._buffer = const_cast<double*>(all.data());
    check(dds_write(large_requests_, &request));
    return answer();
  }
  void drive(std::int64_t count) override {
    const cyclone_Request command{false, 0.5f, -0.25f};
    for (; count > 0; --count) check(dds_write(gathered_requests_, &command));
    const cyclone_Request last{true, 0.5f, 0.5f};
    check(dds_write(gathered_requests_, &last));  // after all of them: one writer keeps its order
    dds_write_flush(gathered_requests_);
    answer();
  }

 private:
  /// Both sides have to know of each other.
  void wait_for_server() const {
    for (const dds_entity_t writer : {requests_, large_requests_, gathered_requests_}) {
      dds_publication_matched_status_t status{};
      while (status.current_count == 0) {
        dds_sleepfor(DDS_MSECS(10));
        check(dds_get_publication_matched_status(writer, &status));
      }
    }
    dds_subscription_matched_status_t status{};
    while (status.current_count == 0) {
      dds_sleepfor(DDS_MSECS(10));
      check(dds_get_subscription_matched_status(replies_, &status));
    }
    dds_sleepfor(DDS_MSECS(200));  // The other side may match a little later.
  }
  std::int32_t answer() const {
    std::int32_t value = -1;
    while (value < 0) {
      if (check(dds_waitset_wait(waits_, nullptr, 0, DDS_SECS(10))) == 0) {
        throw std::runtime_error("Cyclone DDS: no answer came");
      }
      take<cyclone_Reply>(replies_, [&](const cyclone_Reply& reply) { value = reply.value; });
    }
    return value;
  }

  Side side_;
  dds_entity_t requests_ = 0;
  dds_entity_t large_requests_ = 0;
  dds_entity_t gathered_requests_ = 0;
  dds_entity_t replies_ = 0;
  dds_entity_t there_ = 0;
  dds_entity_t waits_ = 0;
};

}  // namespace

Peer cyclonedds() {
  return {"cyclonedds", [] { return std::make_unique<CycloneServer>(); },
          [](const std::string&) { return std::make_unique<CycloneClient>(); }};
}

}  // namespace armature::benchmarks::peers
