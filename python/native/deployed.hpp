// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "armature/deploy/deployment.hpp"
#include "armature/remote/network.hpp"

namespace armature::python {

/// What loading a deployment needs beside its file.
struct Request {
  std::string file;
  std::string text;                          ///< that stands for the file's; empty: the file's own
  std::vector<std::string> overrides;        ///< `PID1.Kp=200`
  std::vector<std::string> library_folders;  ///< looked through before all others
};

/// A deployment that was loaded and checked, with what its placeholders need, which outlives it.
/// @thread the one that made it
class Deployed {
 public:
  explicit Deployed(const Request& request);

  const base::Diagnostics& diagnostics() const { return deployment_.diagnostics; }
  const std::string& name() const { return deployment_.document.application; }
  bool has_model(const std::string& model) const;
  /// Once: the application has it then.
  deploy::Deployment take() { return std::move(deployment_); }

 private:
  std::unique_ptr<remote::Network> network_;
  deploy::Deployment deployment_;
};

}  // namespace armature::python
