// SPDX-License-Identifier: Apache-2.0
#pragma once

// Everything that the author of a component needs.

#include "armature/component/check.hpp"
#include "armature/component/command.hpp"
#include "armature/component/component.hpp"
#include "armature/component/event.hpp"
#include "armature/component/holding.hpp"
#include "armature/component/input_port.hpp"
#include "armature/component/operation.hpp"
#include "armature/component/operators_word.hpp"
#include "armature/component/output_port.hpp"
#include "armature/component/port_array.hpp"
#include "armature/component/properties.hpp"
#include "armature/component/property.hpp"
#include "armature/component/registry.hpp"
#include "armature/component/state_machine.hpp"
#include "armature/types/struct.hpp"
