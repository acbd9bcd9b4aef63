// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/interface_file.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"
#include "armature/remote/internal/described_component.hpp"
#include "idl/load.hpp"

namespace armature::remote {
namespace {

struct Wanted {
  std::string file;
  std::string interface;  ///< empty: none is named
};

Wanted split(const std::string& path) {
  const std::size_t mark = path.rfind('#');
  if (mark == std::string::npos || path.find('/', mark) != std::string::npos) return {path, {}};
  return {path.substr(0, mark), path.substr(mark + 1)};
}

std::string_view name_there(const document::Component& written) {
  const std::string_view address = written.remote.name;
  return address.substr(address.rfind('/') + 1);
}

/// The one that is named, else the only one, else the one of the component's name there.
const idl::Interface* choose(const std::vector<idl::Interface>& all, const Wanted& wanted,
                             const document::Component& written, base::Diagnostics& diagnostics) {
  const bool is_named = !wanted.interface.empty();
  if (!is_named && all.size() == 1) return &all.front();
  const std::string name = is_named ? wanted.interface : std::string(name_there(written));
  const auto found = std::ranges::find(all, name, &idl::Interface::name);
  if (found != all.end()) return &*found;
  std::vector<std::string> names;
  for (const idl::Interface& each : all) names.push_back(each.name);
  const base::Location& where = written.interface.where;
  if (all.empty()) {
    diagnostics.error(where, base::quoted(wanted.file) + " has no interface",
                      "name the file that defines it");
  } else if (is_named) {
    diagnostics.error(where, base::quoted(wanted.file) + " has no interface " + base::quoted(name),
                      base::suggestion(name, names));
  } else {
    diagnostics.error(where,
                      base::quoted(wanted.file) + " has " + std::to_string(all.size()) +
                          " interfaces, and none of them is called " + base::quoted(name) +
                          ", as the component at " + written.remote.name + " is",
                      "say which: interface: " + written.interface.name + "#" + names.front());
  }
  return nullptr;
}

/// That the file itself is missing is a mistake of the deployment, not of the file.
void report(const idl::Loaded& loaded, const document::Component& written,
            base::Diagnostics& diagnostics) {
  for (base::Diagnostic each : loaded.diagnostics.all()) {
    if (loaded.sources.empty()) {
      each.where = written.interface.where;
      each.message = base::quoted(written.name) + ", interface: " + each.message;
    }
    diagnostics.add(std::move(each));
  }
}

}  // namespace

std::vector<std::string> interfaces_of(const std::string& path, base::Diagnostics& diagnostics) {
  const Wanted wanted = split(path);
  if (!wanted.interface.empty()) return {path};
  const idl::Loaded loaded = idl::load(wanted.file);
  diagnostics.append(loaded.diagnostics);
  if (!loaded.ok()) return {};
  std::vector<std::string> all;
  for (const idl::Interface& each : loaded.program.main().interfaces) {
    all.push_back(path + "#" + each.name);
  }
  if (all.empty()) diagnostics.error({path, 0, 0}, base::quoted(path) + " has no interface");
  return all;
}

std::unique_ptr<component::Component> read_interface(document::Component& written,
                                                     const std::string& path,
                                                     base::Diagnostics& diagnostics) {
  const Wanted wanted = split(path);
  const idl::Loaded loaded = idl::load(wanted.file);
  report(loaded, written, diagnostics);
  if (!loaded.ok()) return nullptr;
  const idl::Interface* const interface =
      choose(loaded.program.main().interfaces, wanted, written, diagnostics);
  if (interface == nullptr) return nullptr;
  written.model = interface->name;
  return internal::describe(written.name, loaded.program, *interface, diagnostics);
}

}  // namespace armature::remote
