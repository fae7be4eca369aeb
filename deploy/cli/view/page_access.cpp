#include "deploy/cli/view/page_access.hpp"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "common/site/rpc_security.hpp"

namespace longreach {
namespace {

bool equal_names(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

/// Compares in constant time.
bool equal_secrets(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return difference == 0;
}

/// Returns the path after the token, with its slash, or std::nullopt if the token is wrong.
std::optional<std::string_view> behind_token(const std::string& token, std::string_view path) {
  if (token.empty() || !path.starts_with('/')) return std::nullopt;
  path.remove_prefix(1);
  const std::string_view given = path.substr(0, path.find('/'));
  if (!equal_secrets(given, token)) return std::nullopt;
  return path.substr(given.size());
}

/// "localhost:8080", "127.0.0.1", "[::1]:47333"; a browser omits port 80.
bool is_loopback_name(std::string_view host) {
  const auto colon = host.rfind(':');
  const bool port = colon != std::string_view::npos && host.find(']', colon) == std::string_view::npos;
  const std::string_view number = port ? host.substr(colon + 1) : "80";
  const std::string_view name = host.substr(0, port ? colon : host.size());
  const bool digits =
      !number.empty() && std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
  return digits && (equal_names(name, "localhost") || is_loopback(std::string(name) + ":80"));
}

bool own_origin(const ViewRequest& request) {
  // Browsers always send the origin of a script; other programs need not.
  if (request.origin.empty()) return true;
  constexpr std::string_view kScheme = "http://";
  return request.origin.starts_with(kScheme) &&
         equal_names(request.origin.substr(kScheme.size()), request.host);
}

}  // namespace

ViewAnswer answer(const PageAccess& access, const ViewRequest& request) {
  if (access.loopback && !is_loopback_name(request.host)) return ViewAnswer::kForbidden;
  const auto path = behind_token(access.token, request.target.substr(0, request.target.find('?')));
  if (!path || !own_origin(request)) return ViewAnswer::kForbidden;
  if (request.method != "GET") return ViewAnswer::kNotAllowed;
  if (*path == "/live") return request.upgrade ? ViewAnswer::kLive : ViewAnswer::kNotAllowed;
  if (*path == "/") return ViewAnswer::kPage;
  if (*path == "/view.js") return ViewAnswer::kScript;
  if (*path == "/view.css") return ViewAnswer::kStyle;
  return ViewAnswer::kNotFound;
}

bool is_let_in(ViewAnswer answer) { return answer != ViewAnswer::kForbidden; }

std::string draw_token() {
  std::array<std::uint8_t, 26> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the system provides no random numbers for the page token");
  // 5 bits per letter.
  std::string token;
  for (const std::uint8_t byte : bytes) token += "abcdefghijkmnpqrstuvwxyz23456789"[byte % 32];
  return token;
}

}  // namespace longreach
