// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/cli/support/known_secrets.h"
#include "app/cli/support/redaction.h"
#include "app/cli/support/support_file.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli::support {

/// A support file that is being collected: every text that is added loses its secrets.
/// Thread-bound.
class Collection {
 public:
  explicit Collection(const KnownSecrets& secrets);

  /// Adds a text without its secrets. Error in its place: it is left out for that reason.
  void add(const std::string& name, const Result<std::string>& text);
  /// Adds a picture unchanged.
  void add_picture(const std::string& name, Result<std::string> picture);
  void leave_out(const std::string& name, const std::string& reason);

  /// The files after their list.
  SupportFile finish() &&;

 private:
  void store(ArchivedFile file);

  Redaction redaction_;
  SupportFile file_;
  std::size_t changed_ = 0;  ///< files from which something was removed
  std::size_t size_ = 0;     ///< bytes of all files
};

}  // namespace orbwatch::app::cli::support
