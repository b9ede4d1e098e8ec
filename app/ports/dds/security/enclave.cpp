// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/security/enclave.h"

#include "app/ports/dds/security/signed_document.h"
#include "hal/regular_file.h"

namespace orbwatch::app::dds {
namespace {

namespace fs = std::filesystem;

Result<Certificate> read_valid_certificate(const fs::path& file, const Now& now) {
  auto certificate = read_certificate(file);
  if (!certificate) return certificate;
  const auto checked = check_dates(file, *certificate, now);
  if (!checked) return tl::unexpected(checked.error());
  return certificate;
}

Result<> check_governance(const EnclaveFiles& files, const Certificate& signer, int domain) {
  return read_document(files.governance, signer)
      .and_then([&](const std::string& text) {
        return of_file(files.governance, governed_domains(text));
      })
      .and_then([&](const std::vector<DomainRange>& domains) -> Result<> {
        if (contains(domains, domain)) return {};
        return fail(files.governance.string() + ": is not for domain " + std::to_string(domain));
      });
}

Result<> check_permissions(const EnclaveFiles& files, const Certificate& signer,
                           const std::string& subject, int domain, const Now& now) {
  const std::string name = files.permissions.string();
  const auto grants = read_document(files.permissions, signer).and_then([&](const auto& text) {
    return of_file(files.permissions, read_permissions(text));
  });
  if (!grants) return tl::unexpected(grants.error());
  const Grant* grant = find_grant(*grants, subject);
  if (!grant) {
    return fail(name + ": permits nothing to " + subject + ", whose certificate is " +
                files.certificate.string());
  }
  if (!contains(grant->domains, domain)) {
    return fail(name + ": is not for domain " + std::to_string(domain));
  }
  return check_dates(files.permissions, grant->validity, now);
}

}  // namespace

EnclaveFiles::EnclaveFiles(const fs::path& folder)
    : identity_ca(folder / "identity_ca.cert.pem"),
      permissions_ca(folder / "permissions_ca.cert.pem"),
      certificate(folder / "cert.pem"),
      key(folder / "key.pem"),
      governance(folder / "governance.p7s"),
      permissions(folder / "permissions.p7s") {}

Result<std::string> read_document(const fs::path& file, const Certificate& signer) {
  return hal::read_regular_file(file).and_then([&](const std::string& document) {
    return of_file(file, verified_document(document, signer)).map_error([&](const Error& error) {
      return Error{error.message + "; it must be as " + subject_of(signer) + " signed it"};
    });
  });
}

Result<> check_enclave(const EnclaveFiles& files, int domain, const Now& now) {
  const auto identity_ca = read_valid_certificate(files.identity_ca, now);
  if (!identity_ca) return tl::unexpected(identity_ca.error());
  const auto permissions_ca = read_valid_certificate(files.permissions_ca, now);
  if (!permissions_ca) return tl::unexpected(permissions_ca.error());
  const auto certificate = read_valid_certificate(files.certificate, now);
  if (!certificate) return tl::unexpected(certificate.error());
  const auto key = read_key(files.key);
  if (!key) return tl::unexpected(key.error());
  if (!is_issued_by(*certificate, *identity_ca)) {
    return fail(files.certificate.string() + ": was not issued by " + files.identity_ca.string());
  }
  return check_pair(files.key, *key, files.certificate, *certificate)
      .and_then([&] { return check_governance(files, *permissions_ca, domain); })
      .and_then([&] {
        return check_permissions(files, *permissions_ca, subject_of(*certificate), domain, now);
      });
}

}  // namespace orbwatch::app::dds
