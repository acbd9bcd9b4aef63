// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/component/component.hpp"
#include "armature/document/document.hpp"

namespace armature::remote {

/// Makes a component as an interface file describes it, without any C++. It is not to be run: a
/// placeholder stands for it. Mistakes of the file are told at their places in it; what it declares
/// that cannot be here is left out, with a note.
/// @param written  with `remote` and `interface`; its `model` becomes the interface's name
/// @param path     `FILE.idl` or `FILE.idl#Interface`. Without a name it is the only interface of
///                 the file, or the one of the name that the component has in its process
/// @return nullptr after an error
std::unique_ptr<component::Component> read_interface(document::Component& written,
                                                     const std::string& path,
                                                     base::Diagnostics& diagnostics);

/// `FILE.idl#Interface` for each interface that `path` names: all of a file, or the one behind `#`.
/// Mistakes are told as `read_interface` does; none after an error.
std::vector<std::string> interfaces_of(const std::string& path, base::Diagnostics& diagnostics);

}  // namespace armature::remote
