// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/security/participant_security.h"

#include <dlfcn.h>

#include <array>
#include <string>
#include <system_error>

#include "app/ports/dds/security/enclave.h"

namespace orbwatch::app::dds {
namespace {

namespace fs = std::filesystem;

/// A plugin, with the names that Cyclone DDS uses (docs/manual/security).
struct Plugin {
  const char* property;  ///< prefix of its properties
  const char* file;
  const char* init;
  const char* finalize;
};

constexpr std::array kPlugins{
    Plugin{"dds.sec.auth.", "libdds_security_auth.so", "init_authentication",
           "finalize_authentication"},
    Plugin{"dds.sec.access.", "libdds_security_ac.so", "init_access_control",
           "finalize_access_control"},
    Plugin{"dds.sec.crypto.", "libdds_security_crypto.so", "init_crypto", "finalize_crypto"}};

/// Folder from which Cyclone DDS itself was loaded.
fs::path library_folder() {
  Dl_info info{};
  // Looks up the library's own symbol, because its address in the program may differ.
  const void* const known = ::dlsym(RTLD_DEFAULT, "dds_create_participant");
  if (!known || ::dladdr(known, &info) == 0) return {};
  std::error_code error;
  return fs::canonical(info.dli_fname, error).parent_path();
}

bool has_plugins(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / kPlugins[0].file, error);
}

/// Folder of the plugins: named like libddsc's package on Debian, beside libddsc elsewhere.
Result<fs::path> plugin_folder() {
  const fs::path libraries = library_folder();
  if (has_plugins(libraries)) return libraries;
  std::error_code error;
  for (fs::directory_iterator entry(libraries, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& folder = entry->path();
    if (folder.filename().string().starts_with("libddsc") && has_plugins(folder)) return folder;
  }
  return fail("DDS security: there is no " + (libraries / kPlugins[0].file).string() +
              ", nor in a folder libddsc... beside it; was Cyclone DDS built with security?");
}

void set(const Qos& qos, const std::string& name, const std::string& value) {
  dds_qset_prop(qos.get(), name.c_str(), value.c_str());
}

void set_file(const Qos& qos, const std::string& name, const fs::path& file) {
  set(qos, "dds.sec." + name, "file:" + file.string());
}

Result<> set_plugins(const Qos& qos) {
  return plugin_folder().map([&](const fs::path& folder) {
    for (const Plugin& plugin : kPlugins) {
      const std::string property = std::string(plugin.property) + "library.";
      set(qos, property + "path", (folder / plugin.file).string());
      set(qos, property + "init", plugin.init);
      set(qos, property + "finalize", plugin.finalize);
    }
  });
}

/// Follows links to the folder once: files that are replaced by another link are read as one set.
EnclaveFiles files_behind_links(const fs::path& folder) {
  std::error_code error;
  const fs::path real = fs::canonical(folder, error);
  return EnclaveFiles(error ? folder : real);  // the check names what is missing
}

Result<> check_files(const EnclaveFiles& files, int domain, Dates dates) {
  return check_enclave(files, domain, now_for(dates)).map_error([](const Error& error) {
    return Error{"DDS security: " + error.message};
  });
}

}  // namespace

Result<> check_security(const SecuritySettings& settings, int domain, Dates dates) {
  return check_files(files_behind_links(settings.folder), domain, dates);
}

Result<Qos> security_qos(const SecuritySettings& settings, int domain) {
  const EnclaveFiles files = files_behind_links(settings.folder);
  if (const auto checked = check_files(files, domain, Dates::Checked); !checked) {
    return tl::unexpected(checked.error());
  }
  Qos qos(dds_create_qos());
  if (const auto plugins = set_plugins(qos); !plugins) return tl::unexpected(plugins.error());
  set_file(qos, "auth.identity_ca", files.identity_ca);
  set_file(qos, "auth.identity_certificate", files.certificate);
  set_file(qos, "auth.private_key", files.key);
  set_file(qos, "access.permissions_ca", files.permissions_ca);
  set_file(qos, "access.governance", files.governance);
  set_file(qos, "access.permissions", files.permissions);
  return qos;
}

}  // namespace orbwatch::app::dds
