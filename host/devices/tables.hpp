// The catalogue for people: `fencepost devices` and share/doc/devices.md.
#pragma once

#include <span>
#include <string>

#include "host/devices/device_spec.hpp"

namespace fencepost::devices {

/// The devices of a use, as `fencepost devices` lists them: names, places, options. `kinds`: of these alone; none: all.
std::string help_for(Use use, std::span<const std::string> kinds = {});

/// The whole of share/doc/devices.md.
std::string devices_document();

/// The whole of tests/host/devices/facts.txt, of which the devices' pages are made: lens, remedy, what each can tell.
std::string device_facts();

}  // namespace fencepost::devices
