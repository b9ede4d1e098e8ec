// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/certificates/certificate.h"
#include "app/ports/web/web_settings.h"

namespace orbwatch::app::web::tests {

inline std::chrono::sys_seconds this_second() {
  return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
}

/// Validity that began a day ago.
inline ValidityPeriod valid_for(std::chrono::seconds time) {
  return {this_second() - std::chrono::days(1), this_second() + time};
}

inline void write_pem(const std::filesystem::path& file, const std::string& text,
                      mode_t mode = 0600) {
  std::ofstream(file) << text;
  ::chmod(file.c_str(), mode);
}

/// Files of a certificate issued by an authority, and settings that name them.
struct PemFiles {
  explicit PemFiles(const std::filesystem::path& folder,
                    const ValidityPeriod& validity = valid_for(std::chrono::days(90)))
      : certificate(folder / "own.cert.pem"),
        key(folder / "own.key.pem"),
        authority(make_credential("authority", CertificateUse::IssueIdentities, validity).value()),
        own(make_credential("ball", CertificateUse::Serve, validity, &authority, {"ball.example"})
                .value()) {
    write_pem(certificate, to_pem(own.certificate).value() + to_pem(authority.certificate).value(),
              0644);
    write_pem(key, to_pem(own.key).value());
  }

  WebSettings settings() const {
    WebSettings settings;
    settings.certificate = certificate;
    settings.key = key;
    settings.https_port = 0;
    return settings;
  }

  std::filesystem::path certificate, key;
  Credential authority, own;
};

}  // namespace orbwatch::app::web::tests
