// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"

namespace armature::bundle {

/// What is to be made, and of what.
struct BundleRequest {
  std::string file;                    ///< the deployment, absolute
  std::vector<std::string> overrides;  ///< of the run, as `--set` has them
  std::string mode;                    ///< in which it starts; empty: what the deployment says
  std::string script;                  ///< that commands it, absolute; empty: none
  std::vector<std::string> library_folders;  ///< for component libraries, before all others
  std::string out;           ///< what is made; empty: named after the application, in this folder
  bool package = false;      ///< a Debian package in place of a folder
  std::string architecture;  ///< as Debian calls it; empty: this machine's
  std::string installation;  ///< folder of an installed Armature; empty: that of `program`
  /// Root of a system for the target, such as scripts/sysroot makes, where the bundle checks itself
  /// in emulation; empty: what cross compilers have brought.
  std::string system;
  std::string program;            ///< `armature` that runs
  std::string version;            ///< of it
  std::function<bool()> stopped;  ///< whether somebody wants it no more
};

/// Puts a deployment and all that it needs to run on another machine into a folder or a Debian
/// package. What is made has passed the check from where it lies. After an error there is nothing,
/// or what was there before.
/// @param document  of the deployment, which has passed the check
/// @return the path of what was made; empty after an error
std::string make_bundle(const BundleRequest& request, const document::Document& document,
                        base::Diagnostics& diagnostics);

/// `make_bundle` as who loads this library when it is asked for has it.
using MakeBundle = std::string(const BundleRequest&, const document::Document&, base::Diagnostics&);
inline constexpr const char* kMakeBundleSymbol = "armature_bundle_make";

}  // namespace armature::bundle
