// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"
#include "armature/exec/blueprint.hpp"

namespace armature::deploy {

// Components with `autosave`: the last property file of each, which is replaced as a whole, so that
// a crash leaves the old one or the new one.

/// The components that keep something for their next run (component::Keeping) take what their
/// files, which have been read, say. Writes nothing.
void take_kept(const document::Document& document, const exec::Blueprint& blueprint,
               base::Diagnostics& diagnostics);

/// Their files say from now on that a run has begun. To be called before the start; after an error
/// nothing may be started: what would be believed after a crash is old.
void begin_kept(const document::Document& document, const exec::Blueprint& blueprint,
                base::Diagnostics& diagnostics);

/// Their files say again what they said before `begin_kept`: the start was refused.
void give_back_kept(const document::Document& document, const exec::Blueprint& blueprint,
                    base::Diagnostics& diagnostics);

/// Writes the persistent properties of each component with `autosave` to its last property file.
/// What a component that keeps something cannot vouch for is not kept, with a warning that says
/// why. To be called after the application stopped, or before it started.
void save_properties(const document::Document& document, const exec::Blueprint& blueprint,
                     base::Diagnostics& diagnostics);

}  // namespace armature::deploy
