#pragma once

#include <span>
#include <string>
#include <string_view>

namespace barehand {

/// Whether `host`, the header Host of a request, is a name of this machine: localhost, a numeric IP address or the
/// machine's own name. Any other name may belong to an attacker who lets it resolve to this machine, so that a page of
/// the attacker could read what is served here (DNS rebinding).
bool is_own_host(std::string_view host);

/// Why a text is no origin, that is SCHEME://HOST or SCHEME://HOST:PORT or "file://"; "" if it is one.
std::string wrong_origin(const std::string& text);

/// Whether a page from `origin`, the header Origin, may use what is served as `host`. Allowed are the page that this
/// server delivers, pages from an origin in `allowed_origins` ("https://example.org"), and an empty origin: browsers
/// send the header, so the request does not come from a foreign page.
bool is_allowed_origin(std::string_view origin, std::string_view host, std::span<const std::string> allowed_origins);

}  // namespace barehand
