// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace orbwatch::app::web {

/// A file that the build makes of page/files, embedded.
struct PageFile {
  std::string_view name;
  std::string_view content;
  std::string_view packed;  ///< the content, compressed by gzip
};

/// The page: index.html and the files that it loads.
extern const std::span<const PageFile> kPageFiles;

/// Media type by the extension; empty: an extension that the page does not use.
std::string_view page_type(std::string_view name);

}  // namespace orbwatch::app::web
