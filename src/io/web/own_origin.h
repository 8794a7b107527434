#pragma once

#include <span>
#include <string>
#include <string_view>

namespace barehand {

/// Whether `host`, the header Host of a request, is a name that only this machine goes by: localhost, a number address,
/// the machine's own name. Any other name may be a foreign one that its owner points at this machine, so that his page
/// can read what is served here (DNS rebinding).
bool is_own_host(std::string_view host);

/// Whether a page from `origin`, the header Origin, may use what is served as `host`: the page that was served here
/// itself, one from an origin in `invited` ("https://example.org"), or no page at all (""), since only browsers send
/// the header.
bool is_welcome(std::string_view origin, std::string_view host, std::span<const std::string> invited);

}  // namespace barehand
