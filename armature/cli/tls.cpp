// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/tls.hpp"

#include "armature/cli/loaded.hpp"

namespace armature::cli {

std::shared_ptr<ride::Transport> load_tls(const tls::Options& files,
                                          base::Diagnostics& diagnostics) {
  void* const make =
      load_function("libarmature_tls.so", tls::kMakeTransport, "tls needs", diagnostics);
  if (make == nullptr) return nullptr;
  return std::shared_ptr<ride::Transport>(
      reinterpret_cast<tls::MakeTransport>(make)(files, diagnostics));
}

}  // namespace armature::cli
