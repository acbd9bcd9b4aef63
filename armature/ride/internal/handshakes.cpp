// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/handshakes.hpp"

namespace armature::ride::internal {

/// Comes from the node's thread and goes back to it.
struct Handshakes::Job final : rt::Message {
  explicit Job(std::shared_ptr<Link> whose)
      : rt::Message([](rt::Message& self) {
          Job& job = static_cast<Job&>(self);
          job.progress = job.link->step_held();
        }),
        link(std::move(whose)) {}

  const std::shared_ptr<Link> link;
  Progress progress = Progress::kWantRead;
};

void Handshakes::add(std::shared_ptr<Link> link) {
  wanted_.push(*std::make_unique<Job>(std::move(link)).release());
  changed_.notify();
  if (thread_ != nullptr) return;
  platform::ThreadRequest request;
  request.name = name_;
  request.prefault = false;  // Like the node's: a small server is to stay small.
  thread_ = std::make_unique<platform::Thread>(request, [this] { run(); });
}

void Handshakes::stop() {
  ends_.store(true);
  changed_.notify();
  thread_.reset();
  settle(done_);
  settle(wanted_);
}

void Handshakes::settle(rt::Inbox& jobs) {
  for (rt::Message* message = jobs.take_all(); message != nullptr;) {
    const std::unique_ptr<Job> job(static_cast<Job*>(message));
    message = rt::Inbox::next(*message);
    settle_(*job->link, job->progress);
  }
}

void Handshakes::run() {
  // Only here: whoever makes a thread waits until it has begun.
  platform::run_when_idle();
  while (!ends_.load()) {
    changed_.wait();
    for (rt::Message* message = wanted_.take_all(); message != nullptr;) {
      rt::Message* const next = rt::Inbox::next(*message);
      if (!ends_.load()) message->deliver();
      done_.push(*message);
      wake_();
      message = next;
    }
  }
}

}  // namespace armature::ride::internal
