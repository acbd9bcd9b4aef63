// SPDX-License-Identifier: Apache-2.0
#pragma once

// Another vendor's DDS, Fast DDS, with types by its own generator: who our node talks to in tests.

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include "ros_messagesPubSubTypes.h"

namespace armature::ros2 {

namespace fast = eprosima::fastdds::dds;

/// Waits until `reached`, ten seconds at most; answers whether it is.
inline bool wait_until(const std::function<bool()>& reached) {
  for (int k = 0; k < 10000; ++k) {
    if (reached()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return reached();
}

/// What its topics promise, as ROS 2's defaults have it unless said otherwise.
struct FastQuality {
  bool reliable = true;
  bool transient_local = false;
  int depth = 4000;
};

/// How a peer finds others on this machine.
enum class Asks {
  kByUnicast,
  kByMulticast,  ///< as rmw_fastrtps of ROS 2 Humble does under ROS_LOCALHOST_ONLY
};

/// A participant on the loopback interface.
class FastPeer {
 public:
  explicit FastPeer(int domain, Asks asks = Asks::kByUnicast) {
    fast::DomainParticipantQos qos;
    const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList.emplace_back("127.0.0.1");
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    if (asks == Asks::kByUnicast) {
      eprosima::fastrtps::rtps::Locator_t peer;
      eprosima::fastrtps::rtps::IPLocator::setIPv4(peer, "127.0.0.1");
      qos.wire_protocol().builtin.initialPeersList.push_back(peer);
    }
    participant_ = fast::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(domain), qos);
    publisher_ = participant_->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  }
  FastPeer(const FastPeer&) = delete;
  FastPeer& operator=(const FastPeer&) = delete;
  ~FastPeer() {
    participant_->delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  /// @param type  the generated TypeSupport, such as JointState_PubSubType
  template <typename PubSubType>
  fast::DataWriter* write_to(const std::string& topic, const FastQuality& quality = {}) {
    fast::DataWriterQos qos = fast::DATAWRITER_QOS_DEFAULT;
    set(qos, quality);
    return publisher_->create_datawriter(topic_of<PubSubType>(topic), qos);
  }
  template <typename PubSubType>
  fast::DataReader* read_from(const std::string& topic, const FastQuality& quality = {}) {
    fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
    set(qos, quality);
    return subscriber_->create_datareader(topic_of<PubSubType>(topic), qos);
  }

 private:
  template <typename Qos>
  static void set(Qos& qos, const FastQuality& quality) {
    qos.reliability().kind =
        quality.reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind = quality.transient_local ? fast::TRANSIENT_LOCAL_DURABILITY_QOS
                                                    : fast::VOLATILE_DURABILITY_QOS;
    qos.history().kind = fast::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = quality.depth;
    qos.endpoint().history_memory_policy =
        eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  }
  template <typename PubSubType>
  fast::Topic* topic_of(const std::string& name) {
    const fast::TypeSupport type(new PubSubType());
    type.register_type(participant_);
    if (auto* const known = participant_->find_topic(name, eprosima::fastrtps::Duration_t(0, 1))) {
      return known;
    }
    return participant_->create_topic(name, type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  }

  fast::DomainParticipant* participant_;
  fast::Publisher* publisher_;
  fast::Subscriber* subscriber_;
};

inline bool is_matched(fast::DataWriter& writer) {
  fast::PublicationMatchedStatus status;
  writer.get_publication_matched_status(status);
  return status.current_count > 0;
}
inline bool is_matched(fast::DataReader& reader) {
  fast::SubscriptionMatchedStatus status;
  reader.get_subscription_matched_status(status);
  return status.current_count > 0;
}

/// The next sample of a reader.
template <typename Message>
bool take(fast::DataReader& reader, Message& message) {
  fast::SampleInfo info;
  while (reader.take_next_sample(&message, &info) ==
         eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
    if (info.valid_data) return true;
  }
  return false;
}

}  // namespace armature::ros2
