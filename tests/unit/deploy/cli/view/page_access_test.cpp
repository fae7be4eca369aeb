#include "deploy/cli/view/page_access.hpp"

#include <gtest/gtest.h>

#include <set>

namespace longreach::page_access_test {
namespace {

const PageAccess kLoopback{"t", true};
const PageAccess kToken{"secret", false};

ViewRequest get(std::string_view target) {
  return {.method = "GET", .target = target, .host = "127.0.0.1:8080", .origin = {}};
}

TEST(PageAccess, AnswersWhatThereIs) {
  EXPECT_EQ(answer(kLoopback, get("/t/")), ViewAnswer::kPage);
  EXPECT_EQ(answer(kLoopback, get("/t/?dark")), ViewAnswer::kPage);
  EXPECT_EQ(answer(kLoopback, get("/t/view.js")), ViewAnswer::kScript);
  EXPECT_EQ(answer(kLoopback, get("/t/view.css")), ViewAnswer::kStyle);
  EXPECT_EQ(answer(kLoopback, get("/t/etc/passwd")), ViewAnswer::kNotFound);
  EXPECT_EQ(answer(kLoopback, get("/t/../view.js")), ViewAnswer::kNotFound);
  EXPECT_EQ(answer(kLoopback, get("/t")), ViewAnswer::kNotFound);
}

TEST(PageAccess, TakesNothingButGetAndTheWebSocket) {
  ViewRequest request = get("/t/");
  for (const char* method : {"POST", "HEAD", "PUT", "OPTIONS", "get", ""}) {
    request.method = method;
    EXPECT_EQ(answer(kLoopback, request), ViewAnswer::kNotAllowed) << method;
  }
  EXPECT_EQ(answer(kLoopback, get("/t/live")), ViewAnswer::kNotAllowed);
  request = get("/t/live");
  request.upgrade = true;
  EXPECT_EQ(answer(kLoopback, request), ViewAnswer::kLive);
}

TEST(PageAccess, RefusesOtherNamesThatLeadHere) {
  for (const char* host : {"localhost:8080", "LocalHost:8080", "[::1]:8080", "127.0.0.1:8081", "127.8.9.1:1",
                           "127.0.0.1", "localhost"}) {
    ViewRequest request = get("/t/");
    request.host = host;
    EXPECT_EQ(answer(kLoopback, request), ViewAnswer::kPage) << host;
  }
  for (const char* host : {"evil.example:8080", "127.0.0.1.evil.example:8080", "192.0.2.7:8080", "",
                           "localhost:8080.evil.example", "localhost:", "[::1", "localhost:8080:8080"}) {
    ViewRequest request = get("/t/");
    request.host = host;
    EXPECT_EQ(answer(kLoopback, request), ViewAnswer::kForbidden) << host;
  }
}

TEST(PageAccess, RefusesScriptsOfOtherPages) {
  ViewRequest request = get("/t/live");
  request.upgrade = true;
  request.origin = "http://127.0.0.1:8080";
  EXPECT_EQ(answer(kLoopback, request), ViewAnswer::kLive);
  for (const char* origin :
       {"http://evil.example", "https://127.0.0.1:8080", "http://localhost:8080", "null"}) {
    request.origin = origin;
    EXPECT_EQ(answer(kLoopback, request), ViewAnswer::kForbidden) << origin;
  }
}

TEST(PageAccess, WantsTheTokenInEveryPath) {
  EXPECT_EQ(answer(kToken, get("/secret/")), ViewAnswer::kPage);
  EXPECT_EQ(answer(kToken, get("/secret/view.js")), ViewAnswer::kScript);
  EXPECT_EQ(answer(kToken, get("/secret")), ViewAnswer::kNotFound);
  for (const char* target :
       {"/", "/view.js", "/secreT/", "/secre/", "/secretx/", "//", "secret/", "/?secret/"})
    EXPECT_EQ(answer(kToken, get(target)), ViewAnswer::kForbidden) << target;
}

TEST(PageAccess, LetsNobodyInWithoutTheTokenNotOnLoopbackEither) {
  for (const char* target : {"/", "/view.js", "/live", "//", "/u/"}) {
    ViewRequest request = get(target);
    request.upgrade = true;
    EXPECT_EQ(answer(kLoopback, request), ViewAnswer::kForbidden) << target;
    EXPECT_EQ(answer({"", true}, request), ViewAnswer::kForbidden) << target;
  }
  EXPECT_FALSE(is_let_in(ViewAnswer::kForbidden));
  EXPECT_TRUE(is_let_in(ViewAnswer::kNotFound));
}

TEST(PageAccess, TokensAreLongAndNeverTheSame) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(draw_token());
  EXPECT_EQ(tokens.size(), 100u);
  EXPECT_EQ(tokens.begin()->size(), 26u);
}

}  // namespace
}  // namespace longreach::page_access_test
