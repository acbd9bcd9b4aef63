// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/release_code.hpp"

#include <string_view>

#include "armature/platform/memory.hpp"

namespace armature::cli {
namespace {

/// Reads, checks and edits deployments and descriptions of robots, and writes reports. No real-time
/// thread ever runs any of it, and it comes back when the run has ended. The program itself stays:
/// the C++ library may use functions of `std::string` that were compiled into it.
constexpr std::string_view kNeverRealTime[] = {
    "libarmature_deploy.so",   "libarmature_document.so", "libarmature_orocos.so",
    "libarmature_analysis.so", "libarmature_report.so",   "libarmature_edit.so",
    "libarmature_replay.so",   "libyaml-cpp.so",          "libyaml-0.so",
    "libpugixml.so",           "liburdfdom_model.so",     "libtinyxml.so",
    "libconsole_bridge.so"};
/// Has something done in the threads of components, where there is an operator, a script or another
/// process.
constexpr std::string_view kOfTools[] = {"libarmature_inspect.so", "libarmature_lua.so",
                                         "liblua5.4-c++.so"};
constexpr std::string_view kOfTheTerminal[] = {"libarmature_browser.so", "libedit.so",
                                               "libtinfo.so", "libbsd.so", "libmd.so"};
/// Components that stand for others, or write for them, run in real-time threads.
constexpr std::string_view kOfTheNetwork[] = {
    "libarmature_remote.so", "libarmature_ride.so",      "libarmature_tls.so", "libssl.so",
    "libcrypto.so",          "libarmature_websocket.so", "libwebsockets.so",   "libcap.so"};

}  // namespace

void release_what_is_not_needed(bool networked, bool browsed, bool scripted) {
  platform::release_code(kNeverRealTime);
  if (!networked) platform::release_code(kOfTheNetwork);
  if (!browsed) platform::release_code(kOfTheTerminal);
  if (!networked && !browsed && !scripted) platform::release_code(kOfTools);
}

}  // namespace armature::cli
