// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "armature/testing/test_types.hpp"

namespace {
std::size_t allocations = 0;
}  // namespace

// Not inline: the compiler would take malloc and delete for a mismatched pair.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace armature::types {
namespace {

template <typename Function>
std::size_t allocations_of(Function function) {
  const std::size_t before = allocations;
  function();
  return allocations - before;
}

class RealTime : public testing::Test {
 protected:
  const Type& type_ = type_of<Everything>();
  const Everything a_ = make_everything();
  Everything b_ = make_everything();
};

TEST_F(RealTime, TheCounterSeesAnAllocation) {
  EXPECT_EQ(allocations_of([] { ::operator delete(::operator new(8)); }), 1u);
}

TEST_F(RealTime, SameShapeDoesNotAllocate) {
  bool same = false;
  EXPECT_EQ(allocations_of([&] { same = same_shape(type_, &a_, &b_); }), 0u);
  EXPECT_TRUE(same);
}

TEST_F(RealTime, AssigningTheSameShapeDoesNotAllocate) {
  b_.q = {7, 8};
  b_.text.back() = '?';
  ASSERT_TRUE(same_shape(type_, &b_, &a_));
  EXPECT_EQ(allocations_of([&] { type_.assign(&b_, &a_); }), 0u);
  EXPECT_EQ(b_, a_);
}

TEST_F(RealTime, EncodingDoesNotAllocate) {
  std::vector<std::byte> bytes(4096);
  std::size_t size = 0;
  EXPECT_EQ(allocations_of([&] { size = encoded_size(type_, &a_); }), 0u);
  ASSERT_LE(size, bytes.size());
  EXPECT_EQ(allocations_of([&] { size = encode_to(type_, &a_, bytes.data()); }), 0u);
  EXPECT_EQ(size, encoded_size(type_, &a_));
}

}  // namespace
}  // namespace armature::types
