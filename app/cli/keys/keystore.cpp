// SPDX-License-Identifier: Apache-2.0
#include "app/cli/keys/keystore.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "app/cli/staged_folder.h"
#include "app/ports/dds/security/enclave.h"
#include "app/ports/dds/security/key_file.h"
#include "app/ports/dds/security/signed_document.h"
#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIdentityCa = "identity_ca";
constexpr const char* kPermissionsCa = "permissions_ca";
constexpr const char* kSubscriberEnclave = "subscriber";
constexpr const char* kPrivate = "private";
constexpr const char* kEnclaves = "enclaves";
/// Limit of a common name in RFC 5280.
constexpr std::size_t kLongestName = 64;
/// Margin for clocks that differ, and for boards without a clock, which start with the time of
/// their last shutdown.
constexpr std::chrono::days kClockDifference{1};

struct Authorities {
  Credential identity;
  Credential permissions;
};

bool is_name(const std::string& name) {
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  return !name.empty() && name.size() <= kLongestName && std::ranges::all_of(name, is_allowed);
}

Result<> check_names(const std::vector<std::string>& names) {
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (!is_name(*name)) {
      return fail("subscriber \"" + *name +
                  "\": a name has 1 to 64 letters, digits, '_' and '-' of ASCII");
    }
    if (*name == kApplianceEnclave || std::find(names.begin(), name, *name) != name) {
      return fail("subscriber \"" + *name + "\": the name is taken, each needs one of its own");
    }
  }
  return {};
}

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

Result<> make_folder(const fs::path& folder) {
  if (::mkdir(folder.c_str(), S_IRWXU) == 0) return {};
  return fail(folder.string() + ": cannot be made: " + std::strerror(errno));
}

ValidityPeriod validity_from(std::chrono::sys_seconds now, int days) {
  return {now - kClockDifference, now + std::chrono::days(days)};
}

fs::path certificate_file(const fs::path& keystore, const std::string& authority) {
  return keystore / kPrivate / (authority + ".cert.pem");
}
fs::path key_file(const fs::path& keystore, const std::string& authority) {
  return keystore / kPrivate / (authority + ".key.pem");
}

Result<> write_certificate(const fs::path& file, const Certificate& certificate) {
  return to_pem(certificate).and_then([&](const std::string& pem) {
    return write_key_file(file, pem, dds::Readable::Everybody);
  });
}

Result<> write_key(const fs::path& file, const Key& key) {
  return to_pem(key).and_then(
      [&](const std::string& pem) { return write_key_file(file, pem, dds::Readable::Owner); });
}

Result<Credential> make_authority(const fs::path& keystore, const std::string& authority,
                                  CertificateUse use, const ValidityPeriod& validity) {
  auto made = make_credential("orbwatch_" + authority, use, validity);
  if (!made) return made;
  const auto written =
      write_certificate(certificate_file(keystore, authority), made->certificate).and_then([&] {
        return write_key(key_file(keystore, authority), made->key);
      });
  if (!written) return tl::unexpected(written.error());
  return made;
}

Result<Authorities> make_authorities(const fs::path& keystore, const ValidityPeriod& validity) {
  return make_folder(keystore / kPrivate)
      .and_then([&] { return make_folder(keystore / kEnclaves); })
      .and_then([&] {
        return make_authority(keystore, kIdentityCa, CertificateUse::IssueIdentities, validity);
      })
      .and_then([&](Credential identity) {
        return make_authority(keystore, kPermissionsCa, CertificateUse::SignDocuments, validity)
            .map([&](Credential permissions) {
              return Authorities{std::move(identity), std::move(permissions)};
            });
      });
}

Result<Credential> read_authority(const fs::path& keystore, const std::string& authority) {
  auto certificate = read_certificate(certificate_file(keystore, authority));
  if (!certificate) return tl::unexpected(certificate.error());
  auto key = read_key(key_file(keystore, authority));
  if (!key) return tl::unexpected(key.error());
  if (!is_key_of(*key, *certificate)) {
    return fail(key_file(keystore, authority).string() + ": is not the key of " +
                certificate_file(keystore, authority).string());
  }
  return Credential{std::move(*key), std::move(*certificate)};
}

Result<Authorities> read_authorities(const fs::path& keystore) {
  return read_authority(keystore, kIdentityCa).and_then([&](Credential identity) {
    return read_authority(keystore, kPermissionsCa).map([&](Credential permissions) {
      return Authorities{std::move(identity), std::move(permissions)};
    });
  });
}

/// Writes `text` beside its signed form, whose name is `document`.
Result<> write_document(const fs::path& document, const std::string& text,
                        const Credential& signer) {
  return dds::sign_document(text, signer)
      .and_then([&](const std::string& signed_text) {
        return write_key_file(document, signed_text, dds::Readable::Everybody);
      })
      .and_then([&] {
        return write_key_file(fs::path(document).replace_extension(".xml"), text,
                              dds::Readable::Everybody);
      });
}

/// Writes all files of the participant `name` into an existing folder.
Result<> write_enclave(const fs::path& folder, const std::string& name,
                       const dds::TopicAccess& topics, const KeystoreRequest& request,
                       const ValidityPeriod& validity, const Authorities& authorities) {
  const dds::EnclaveFiles files(folder);
  const auto made =
      make_credential(name, CertificateUse::Authenticate, validity, &authorities.identity);
  if (!made) return tl::unexpected(made.error());
  const dds::Grant grant{subject_of(made->certificate), validity, {request.domains}, topics};
  return write_certificate(files.identity_ca, authorities.identity.certificate)
      .and_then([&] {
        return write_certificate(files.permissions_ca, authorities.permissions.certificate);
      })
      .and_then([&] { return write_certificate(files.certificate, made->certificate); })
      .and_then([&] { return write_key(files.key, made->key); })
      .and_then([&] {
        return write_document(files.governance,
                              governance_document(request.domains, request.bulk_topics),
                              authorities.permissions);
      })
      .and_then([&] {
        return write_document(files.permissions, permissions_document(grant),
                              authorities.permissions);
      });
}

using Folders = std::vector<fs::path>;

Result<Folders> make_keystore(const KeystoreRequest& request, std::chrono::sys_seconds now) {
  auto staged = StagedFolder::beside(request.folder);
  if (!staged) return tl::unexpected(staged.error());
  const ValidityPeriod validity = validity_from(now, request.days);
  const auto authorities = make_authorities(staged->path(), validity);
  if (!authorities) return tl::unexpected(authorities.error());
  std::vector<std::string> names = request.subscribers;
  if (names.empty()) names.emplace_back(kSubscriberEnclave);
  names.insert(names.begin(), kApplianceEnclave);
  Folders folders;
  for (const std::string& name : names) {
    const auto& topics = name == kApplianceEnclave ? request.appliance : request.subscriber;
    const fs::path folder = enclave_folder(staged->path(), name);
    const auto written = make_folder(folder).and_then(
        [&] { return write_enclave(folder, name, topics, request, validity, *authorities); });
    if (!written) return tl::unexpected(written.error());
    folders.push_back(enclave_folder(request.folder, name));
  }
  const auto placed =
      is_there(certificate_file(request.folder, kIdentityCa)) ? staged->replace() : staged->place();
  if (!placed) return tl::unexpected(placed.error());
  return folders;
}

/// Checks that the appliance of a keystore has the pictures that new subscribers may read.
Result<> check_appliance(const KeystoreRequest& request, const Authorities& authorities) {
  const fs::path folder = enclave_folder(request.folder, kApplianceEnclave);
  const auto grants =
      dds::read_document(dds::EnclaveFiles(folder).permissions, authorities.permissions.certificate)
          .and_then(dds::read_permissions);
  if (!grants) return tl::unexpected(grants.error());
  const auto takes = [&](const dds::Grant& grant) {
    const auto& published = grant.topics.publish;
    return contains(grant.domains, request.domains.first) &&
           contains(grant.domains, request.domains.last) &&
           std::ranges::all_of(request.bulk_topics, [&](const std::string& topic) {
             return std::ranges::find(published, topic) != published.end();
           });
  };
  if (std::ranges::any_of(*grants, takes)) return {};
  return fail(request.folder.string() +
              ": was made for another domain or prefix; say --domain and --prefix as then");
}

Result<fs::path> add_enclave(const KeystoreRequest& request, const std::string& name,
                             const ValidityPeriod& validity, const Authorities& authorities) {
  const fs::path folder = enclave_folder(request.folder, name);
  auto staged = StagedFolder::beside(folder);
  if (!staged) return tl::unexpected(staged.error());
  return write_enclave(staged->path(), name, request.subscriber, request, validity, authorities)
      .and_then([&] { return is_there(folder) ? staged->replace() : staged->place(); })
      .map([&] { return folder; });
}

Result<Folders> add_subscribers(const KeystoreRequest& request, std::chrono::sys_seconds now) {
  for (const std::string& name : request.subscribers) {
    if (is_there(enclave_folder(request.folder, name)) && !request.replace) {
      return fail(enclave_folder(request.folder, name).string() +
                  ": is there already; --replace makes it anew");
    }
  }
  const auto authorities = read_authorities(request.folder);
  if (!authorities) return tl::unexpected(authorities.error());
  const auto until = validity_of(authorities->identity.certificate);
  if (!until) return tl::unexpected(until.error());
  ValidityPeriod validity = validity_from(now, request.days);
  validity.until = std::min(validity.until, until->until);
  if (const auto checked = check_appliance(request, *authorities); !checked) {
    return tl::unexpected(checked.error());
  }
  Folders folders;
  for (const std::string& name : request.subscribers) {
    auto folder = add_enclave(request, name, validity, *authorities);
    if (!folder) return tl::unexpected(folder.error());
    folders.push_back(std::move(*folder));
  }
  return folders;
}

/// Topic of ROS 2's graph: every participant writes and reads it.
constexpr const char* kDiscovery = "ros_discovery_info";

/// All topics except the requests: their readers share the key that protects them, and could forge
/// some.
std::vector<std::string> published(std::string_view prefix) {
  std::vector<std::string> topics = bulk_topics(prefix);
  topics.insert(topics.end(),
                {dds::process_state_topic(prefix), dds::event_topic(prefix),
                 dds::command_result_topic(prefix), "rt/diagnostics", kDiscovery,
                 std::string(dds::kApplianceTopic), std::string(dds::kThumbnailTopic)});
  return topics;
}

}  // namespace

// Topics of views and cameras: all below a name.
std::vector<std::string> bulk_topics(std::string_view prefix) {
  const std::string image = dds::image_topic(prefix, "*");
  return {image.substr(0, image.rfind('/') + 1) + "*"};
}

dds::TopicAccess appliance_access(std::string_view prefix) {
  return {published(prefix),
          {dds::command_topic(prefix), dds::machine_state_topic(prefix), kDiscovery,
           std::string(dds::kApplianceTopic), std::string(dds::kThumbnailTopic)}};
}

dds::TopicAccess reader_access(std::string_view prefix) {
  return {{kDiscovery}, published(prefix)};
}

dds::TopicAccess controller_access(std::string_view prefix) {
  return {{dds::command_topic(prefix), dds::machine_state_topic(prefix), kDiscovery},
          published(prefix)};
}

fs::path enclave_folder(const fs::path& keystore, const std::string& name) {
  return keystore / kEnclaves / name;
}

Result<Folders> make_keys(const KeystoreRequest& request, std::chrono::sys_seconds now) {
  if (const auto checked = check_names(request.subscribers); !checked) {
    return tl::unexpected(checked.error());
  }
  const bool there = is_there(certificate_file(request.folder, kIdentityCa));
  if (there && !request.subscribers.empty()) return add_subscribers(request, now);
  if (!there || request.replace) return make_keystore(request, now);
  return fail(request.folder.string() +
              ": holds keys already; add to them with --subscriber NAME, or --replace them, which "
              "shuts out everybody who has them");
}

}  // namespace orbwatch::app::cli
