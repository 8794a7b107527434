#pragma once

#include <map>
#include <string>

#include "core/error.h"
#include "io/web/web_server.h"

namespace barehand {

/// Reads the files of the live page, by the path under which they are served: those in the folder web/ of the data
/// files and, if its package is installed, three.js under /three/. Error: the page is not installed.
Result<std::map<std::string, WebFile>> read_web_page();

}  // namespace barehand
