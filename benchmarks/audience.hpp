// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>

#include "benchmarks/crew.hpp"

namespace armature::benchmarks {

/// Processes that connect to a port of this one and listen. Of what all of them are to hear, the
/// last tells when it is there.
class Audience {
 public:
  /// In memory that all of them see.
  class Hall {
   public:
    explicit Hall(std::uint32_t size) : size_(size) {}

    /// @thread those of the audience
    void heard();
    std::uint16_t wait_for_port();
    /// @thread the one that speaks
    void open(std::uint16_t port);
    void wait_until_all_have_heard();

   private:
    const std::uint32_t size_;
    std::atomic<std::uint32_t> port_{0};
    std::atomic<std::uint32_t> heard_{0};
    std::atomic<std::uint32_t> all_{0};
  };

  /// @param listen  what each of them does, beginning with `wait_for_port`
  Audience(std::uint32_t size, int cpu, const std::function<void(Hall&)>& listen);

  Hall& hall() { return *hall_; }

 private:
  struct Unmap {
    void operator()(Hall* hall) const;
  };

  std::unique_ptr<Hall, Unmap> hall_;
  std::unique_ptr<Crew> members_;
};

}  // namespace armature::benchmarks
