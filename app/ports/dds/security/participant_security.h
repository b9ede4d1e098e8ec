// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/certificates/dates.h"
#include "app/ports/dds/participant/entity.h"
#include "proc/image/result.h"

namespace orbwatch::app::dds {

/// The credentials of a participant.
struct SecuritySettings {
  std::filesystem::path folder;  ///< holds the files of EnclaveFiles
};

template <class Visitor>
void visit(Visitor& v, SecuritySettings& security) {
  v.required("folder", security.folder,
             "Folder with certificate, key and permissions, made by `orbwatch dds-keys`");
  v.require(!security.folder.empty(), "folder",
            "is empty; set the folder of the keys, as \"keys/enclaves/appliance\"");
}

/// Checks the files like check_enclave(), behind links to the folder as they are at this moment.
Result<> check_security(const SecuritySettings& settings, int domain, Dates dates);

/// QoS that makes a participant of the domain a secure one, by Cyclone DDS' own plugins. Reads the
/// files once to check them; the plugins read them again. Errors: those of check_security(); the
/// plugins are not installed. Reentrant.
Result<Qos> security_qos(const SecuritySettings& settings, int domain);

}  // namespace orbwatch::app::dds
