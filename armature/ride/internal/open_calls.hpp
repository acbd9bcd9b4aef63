// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "armature/ride/internal/assembler.hpp"
#include "armature/ride/internal/open_call.hpp"
#include "armature/ride/memory_share.hpp"

namespace armature::ride::internal {

/// The requests of one connection whose answers have not come. Guarded by the link's lock.
class OpenCalls {
 public:
  /// Gives it an identifier; it stays with its owner.
  void add(OpenCall& call);
  bool has(std::uint32_t id) const;
  /// @return it; nullptr if it is not open
  OpenCall* remove(std::uint32_t id);

  /// Tells the call that `message` answers.
  /// @param share  of which what the answer takes is counted
  /// @return false if it answers none that is open
  bool complete(const Message& message, const std::shared_ptr<MemoryShare>& share);
  /// The first that a thread waits for, which could read; nullptr if there is none.
  WaitingCall* first_waiting() const;
  void refuse_all(Code code, const std::string& why);

 private:
  std::vector<OpenCall*> calls_;
  std::uint32_t last_id_ = 0;
};

}  // namespace armature::ride::internal
