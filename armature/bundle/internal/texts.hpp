// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/time.hpp"

namespace armature::bundle::internal {

/// The file with the hashes of all others.
inline constexpr const char* kSums = "SHA256SUMS";

/// What the texts of a bundle tell.
struct Facts {
  std::string name;                    ///< of the bundle, from the application's
  std::string version;                 ///< of Armature
  std::string architecture;            ///< as Debian calls it
  std::string deployment;              ///< the file's place in the bundle
  std::vector<std::string> options;    ///< of `armature run`, such as --mode
  std::string script;                  ///< the place of the one that commands it; empty: none
  std::set<std::string> packages;      ///< of Debian that it needs
  std::vector<std::string> strangers;  ///< libraries it needs that no package has
  std::vector<std::string> keys;       ///< places at which private keys are to be put
  std::vector<std::string> saved;      ///< places of files that a run writes at its stop
  base::Duration stop_time{};          ///< that an orderly stop may take
};

/// `application` as a name of folders, units and packages; empty if it cannot be one.
std::string name_of_bundle(std::string_view application);

/// Of the Debian package: `armature-wave`.
std::string name_of_package(std::string_view name);

/// Of the unit for systemd: `wave.service`.
std::string name_of_unit(std::string_view name);

/// Of the package's file: `armature-wave_0.1.0_amd64.deb`.
std::string name_of_archive(const Facts& facts);

/// Where the package puts the bundle, and the unit looks for it: `/opt/armature/wave`.
std::string installed_folder(std::string_view name);

/// As one word of a shell script.
std::string shell_word(std::string_view text);

/// The script `run`.
std::string run_script(const Facts& facts);

/// The unit for systemd, which starts nothing by itself.
std::string unit_text(const Facts& facts);

/// What is in the bundle and how it is started.
std::string readme_text(const Facts& facts);

/// Licences of what the bundle has and needs.
std::string licences_text(const Facts& facts);

/// What dpkg wants to know.
std::string control_text(const Facts& facts, std::uint64_t kilobytes);

}  // namespace armature::bundle::internal
