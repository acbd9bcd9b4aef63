// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a process and its guardian share: a piece of memory. The guardian has no library but libc,
// so nothing here needs one.

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace armature::guardian::internal {

constexpr std::uint32_t kPageMagic = 0x44524147;  // "GARD"
constexpr std::uint32_t kPageVersion = 1;
/// The descriptor by which the guardian has the page.
constexpr int kPageDescriptor = 3;

constexpr std::size_t kMostSafe = 64;
constexpr std::size_t kMostQuestions = 32;
constexpr std::size_t kMostAnswers = 64;
constexpr std::size_t kMostDevices = 32;
constexpr std::size_t kMostPacket = 46;
/// Of a field that a packet does not have.
constexpr std::uint16_t kNowhere = 0xffff;

/// Bytes as the bus takes them.
struct Packet {
  std::uint16_t size = 0;
  std::uint8_t bytes[kMostPacket] = {};
};

/// What a device says that is idle. One that may say this or that has several.
struct IdleAnswer {
  std::uint32_t device = 0;  ///< 0, 1, ..
  std::uint32_t id = 0;
  std::uint8_t mask[8] = {};
  std::uint8_t value[8] = {};
};

/// Where things are in the packets of a bus.
struct PacketLayout {
  std::uint16_t time = kNowhere;      ///< of what is sent: i64 ns on the monotonic clock
  std::uint16_t size = 0;             ///< of what is received
  std::uint16_t kind = kNowhere;      ///< of what is received: u32
  std::uint32_t frame = 0;            ///< the kind that is a frame
  std::uint16_t id = 0;               ///< u32
  std::uint16_t extended = kNowhere;  ///< u8, 0 for what counts
  std::uint16_t data = 0;             ///< 8 bytes
};

enum class Way : std::uint32_t { kSocketFile = 1, kInterface = 2 };

/// What the guardian may do, from its start on: it takes a copy, which nobody changes.
struct Orders {
  std::uint32_t magic = kPageMagic;
  std::uint32_t version = kPageVersion;
  std::int32_t process = 0;  ///< whom it guards
  Way way = Way::kInterface;
  char address[108] = {};  ///< a socket file, or the name of an interface
  std::uint32_t filter_id = 0;
  std::uint32_t filter_mask = 0;
  std::int64_t period_ns = 0;  ///< of the cycle
  Packet hello;                ///< said first, if it has a size
  PacketLayout layout;
  std::uint32_t safe_count = 0;
  std::uint32_t question_count = 0;
  std::uint32_t answer_count = 0;
  std::uint32_t device_count = 0;
  Packet safe[kMostSafe];
  Packet questions[kMostQuestions];
  IdleAnswer answers[kMostAnswers];
};

enum class Stage : std::uint32_t { kStarting = 0, kReady = 1, kNoBus = 2, kNoProcess = 3 };

struct Page {
  Orders orders;

  // --- of the guarded process
  alignas(64) std::atomic<std::int64_t> beat_ns{0};  ///< its last cycle, on the monotonic clock
  std::atomic<std::uint32_t> watched{0};             ///< cycles are expected
  std::atomic<std::uint32_t> acknowledged{0};        ///< so many acts of the guardian it knows of
  std::atomic<std::uint32_t> ended{0};               ///< in order

  // --- of the guardian
  alignas(64) std::atomic<std::int64_t> alive_ns{0};  ///< when it looked last
  std::atomic<Stage> stage{Stage::kStarting};
  std::atomic<std::int32_t> error{0};      ///< errno of kNoBus
  std::atomic<std::uint32_t> locked{0};    ///< its memory
  std::atomic<std::uint32_t> urgent{0};    ///< SCHED_FIFO 99
  std::atomic<std::uint32_t> acted{0};     ///< how often it has switched the drives off
  std::atomic<std::int64_t> silent_ns{0};  ///< for how long it had seen no cycle, when it did
};
static_assert(sizeof(Page) <= 2 * 4096);
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

}  // namespace armature::guardian::internal
