#pragma once

#include <map>
#include <string>

#include "core/error.h"
#include "io/web/web_server.h"

namespace barehand {

/// The files of the live page by the path under which they are served: those of the folder web/ among the data files,
/// and of three.js, where its package is installed, under /three/. Errors: the page is not installed.
Result<std::map<std::string, WebFile>> read_web_page();

}  // namespace barehand
