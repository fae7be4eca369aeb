#pragma once
// Access control of the view server. A page of another web site cannot use this server, either under a domain
// name that resolves to this host (the Host header is checked) or through a WebSocket opened from that page
// (the Origin header is checked). A server on loopback has every loopback name and every port, because a tunnel
// (ssh -L) may begin at another port. Every path begins with a token, even on loopback, which other users of this
// machine share. The token is in the path because a cookie would be sent to every port of the host, including
// those of other users. Pure functions.

#include <string>
#include <string_view>

namespace longreach {

struct PageAccess {
  std::string token;      // first component of every path; empty: all access is denied
  bool loopback = false;  // only loopback names of this server are accepted
};

/// The request line and headers of a request; missing parts are empty.
struct ViewRequest {
  std::string_view method;
  std::string_view target;
  std::string_view host;
  std::string_view origin;
  bool upgrade = false;  // the request is an upgrade to a WebSocket
};

enum class ViewAnswer { kPage, kScript, kStyle, kLive, kForbidden, kNotFound, kNotAllowed };

ViewAnswer answer(const PageAccess& access, const ViewRequest& request);
/// Returns whether the answer shows that the request contained the correct token.
bool is_let_in(ViewAnswer answer);

/// Returns 130 random bits as letters and digits.
std::string draw_token();

}  // namespace longreach
