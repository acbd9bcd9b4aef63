// SPDX-License-Identifier: Apache-2.0
// Neither side allocates for messages of fixed size, once the first have gone both ways.
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <new>
#include <thread>

#include <gtest/gtest.h>

#include "armature/ride/internal/test_vision.hpp"
#include "armature/ride/node.hpp"

namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

// Not inline: the compiler would take malloc and delete for a mismatched pair.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new[](std::size_t size) { return ::operator new(size); }
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace armature::ride {
namespace {

using namespace std::chrono_literals;

class Camera : public VisionService {
 public:
  void note(std::int32_t) override { notes.fetch_add(1); }
  std::atomic<int> notes{0};
};

class Allocation : public testing::Test {
 protected:
  Allocation() {
    EXPECT_TRUE(server_.add("camera", service_).ok());
    address_ = server_.listen("tcp://127.0.0.1:0").value().text();
    EXPECT_TRUE(client_.connect(address_).wait_until_connected(20s).ok());
  }

  /// Of the second time: the first makes room.
  template <typename Code>
  static std::size_t allocations_of(Code code) {
    code();
    const std::size_t before = allocations;
    code();
    return allocations - before;
  }

  Camera service_;
  Node server_;
  Node client_;
  std::string address_;
};

TEST_F(Allocation, TheCounterSeesOne) {
  EXPECT_EQ(allocations_of([] { ::operator delete(::operator new(8)); }), 1u);
}

TEST_F(Allocation, NoneInARequest) {
  VisionPlaceholder camera(client_.connect(address_), "camera");
  EXPECT_EQ(allocations_of([&] {
              for (std::uint32_t i = 0; i < 2000; ++i) {
                ASSERT_TRUE(camera.setThreshold(i, 1, 2, {.deadline = 20s, .priority = {}}).ok());
              }
            }),
            0u);
}

TEST_F(Allocation, NoneInCommandsOneByOne) {
  VisionPlaceholder camera(client_.connect(address_), "camera");
  EXPECT_EQ(allocations_of([&] {
              const int end = service_.notes + 500;
              while (service_.notes < end) {
                const int now = service_.notes;
                ASSERT_EQ(camera.note(now), Sent::kYes);
                while (service_.notes == now) std::this_thread::yield();
              }
            }),
            0u);
}

TEST_F(Allocation, NoneInAnEventAndItsHandler) {
  VisionPlaceholder camera(client_.connect(address_), "camera");
  std::atomic<int> seen{0};
  const auto subscription = camera.on_ObjectPosition([&](const ObjectPosition&) { ++seen; });
  ASSERT_TRUE(camera.setThreshold(1, 2, 3, {.deadline = 20s, .priority = {}}).ok());
  EXPECT_EQ(allocations_of([&] {
              for (int i = 0; i < 500; ++i) {
                const int now = seen;
                service_.raise({i, i});
                while (seen == now) std::this_thread::yield();
              }
            }),
            0u);
}

}  // namespace
}  // namespace armature::ride
