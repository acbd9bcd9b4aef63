// SPDX-License-Identifier: Apache-2.0
#pragma once

// Everything that the author of a component needs.

#include "armature/component/check.hpp"
#include "armature/component/component.hpp"
#include "armature/component/events/event.hpp"
#include "armature/component/holding.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/component/operators_word.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/component/ports/port_array.hpp"
#include "armature/component/properties/properties.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/component/registry.hpp"
#include "armature/component/states/state_machine.hpp"
#include "armature/types/struct.hpp"
