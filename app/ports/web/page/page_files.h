// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace orbwatch::app::web {

/// A file of page/files, embedded at build time.
struct PageFile {
  std::string_view name;  ///< path within page/files
  std::string_view content;
};

/// The page: index.html and the files that it loads.
extern const std::span<const PageFile> kPageFiles;

/// Media type by the extension; empty: an extension that the page does not use.
std::string_view page_type(std::string_view name);

}  // namespace orbwatch::app::web
