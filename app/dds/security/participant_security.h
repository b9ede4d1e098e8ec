#pragma once

#include <filesystem>

#include "app/dds/entity.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// With what a participant proves who it is and what it may do.
struct SecuritySettings {
  std::filesystem::path folder;  ///< holds the files of EnclaveFiles
};

/// Whether the files would do at this moment, as check_enclave says it.
Result<> check_security(const SecuritySettings& settings, int domain);

/// QoS that makes a participant of the domain a secure one, by the plugins that come with Cyclone
/// DDS. Reads the files once to check them; the plugins read them again. Errors: as check_security;
/// the plugins are not installed. Reentrant.
Result<Qos> security_qos(const SecuritySettings& settings, int domain);

}  // namespace orbwatch::app
