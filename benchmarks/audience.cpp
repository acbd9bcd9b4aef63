// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/audience.hpp"

#include <climits>
#include <new>
#include <stdexcept>

#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "benchmarks/check.hpp"
#include "benchmarks/on_cpu.hpp"

namespace armature::benchmarks {
namespace {

/// Between processes, other than platform::futex_wait.
void wait_while(std::atomic<std::uint32_t>& word, std::uint32_t value) {
  constexpr timespec kLong{30, 0};
  const long done = syscall(SYS_futex, &word, FUTEX_WAIT, value, &kLong, nullptr, 0);
  if (done != 0 && errno == ETIMEDOUT) throw std::runtime_error("a process of the audience hangs");
}

void wake_all(std::atomic<std::uint32_t>& word) {
  syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

}  // namespace

void Audience::Hall::heard() {
  if ((heard_.fetch_add(1) + 1) % size_ != 0) return;
  all_.store(1);
  wake_all(all_);
}

std::uint16_t Audience::Hall::wait_for_port() {
  while (port_.load() == 0) wait_while(port_, 0);
  return static_cast<std::uint16_t>(port_.load());
}

void Audience::Hall::open(std::uint16_t port) {
  port_.store(port);
  wake_all(port_);
}

void Audience::Hall::wait_until_all_have_heard() {
  while (all_.exchange(0) == 0) wait_while(all_, 0);
}

void Audience::Unmap::operator()(Hall* hall) const { munmap(hall, sizeof *hall); }

Audience::Audience(std::uint32_t size, int cpu, const std::function<void(Hall&)>& listen) {
  void* const memory =
      mmap(nullptr, sizeof(Hall), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  check(memory != MAP_FAILED, "mmap");
  hall_.reset(new (memory) Hall(size));
  const OnCpu there(cpu);
  members_ = std::make_unique<Crew>(size, [&] { listen(*hall_); });
}

}  // namespace armature::benchmarks
