// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "armature/deploy/deployment.hpp"
#include "armature/remote/network.hpp"
#include "python/native/model.hpp"

namespace armature::python {

/// What loading a deployment needs beside its file.
struct Request {
  std::string file;
  std::string text;                          ///< that stands for the file's; empty: the file's own
  std::vector<std::string> overrides;        ///< `PID1.Kp=200`
  std::vector<std::string> library_folders;  ///< looked through before all others
  std::vector<std::shared_ptr<const Model>> models;  ///< in Python
};

/// A deployment that was loaded and checked, with what its placeholders need, which outlives it.
/// @thread the one that made it
class Deployed {
 public:
  explicit Deployed(const Request& request);

  const base::Diagnostics& diagnostics() const { return deployment_.diagnostics; }
  const std::string& name() const { return deployment_.document.application; }
  /// Components that write, by their names.
  std::vector<std::string> writers() const;
  /// Throws a Refusal if a component of it lives in another process: it cannot run without that.
  void expect_alone() const;
  bool has_model(const std::string& model) const;
  /// Once: the application has it then.
  deploy::Deployment take() { return std::move(deployment_); }

 private:
  std::unique_ptr<remote::Network> network_;
  deploy::Deployment deployment_;
};

}  // namespace armature::python
