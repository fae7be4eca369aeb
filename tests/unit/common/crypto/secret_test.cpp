// What is left of a session's secret where it has been.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <new>
#include <variant>

#include "common/crypto/session.hpp"

namespace longreach::secret_test {
namespace {

/// Room that outlives what is built in it.
template <class T>
struct Room {
  alignas(T) std::array<std::byte, sizeof(T)> bytes{};
  template <class... Arguments>
  T* build(Arguments&&... arguments) {
    return new (bytes.data()) T(std::forward<Arguments>(arguments)...);
  }
  /// Bytes of `secret` in a row.
  [[nodiscard]] bool holds(const Secret& secret) const {
    return std::search(bytes.begin(), bytes.end(), secret.begin(), secret.begin() + 8) != bytes.end();
  }
};

TEST(Secret, LeavesNothingWhereItEnds) {
  const Session known = draw_session(Cipher::kChaCha20Poly1305);
  Room<Session> room;
  Session* session = room.build(known);
  EXPECT_TRUE(room.holds(known.secret));  // the search finds it while it is there
  session->~Session();
  EXPECT_FALSE(room.holds(known.secret));
}

TEST(Secret, LeavesNothingWhereItWasMovedFrom) {
  const Session known = draw_session(Cipher::kChaCha20Poly1305);
  Session from = known;
  const Session to = std::move(from);
  EXPECT_EQ(to.secret, known.secret);
  EXPECT_EQ(from.secret, Secret{});
  Session again;
  Session source = known;
  again = std::move(source);
  EXPECT_EQ(again.secret, known.secret);
  EXPECT_EQ(source.secret, Secret{});
}

TEST(Secret, LeavesNothingInACommandThatGivesWayToAnother) {
  using Command = std::variant<int, Session>;
  const Session known = draw_session(Cipher::kChaCha20Poly1305);
  Room<Command> room;
  Command* command = room.build(known);
  EXPECT_TRUE(room.holds(known.secret));
  *command = 0;
  EXPECT_FALSE(room.holds(known.secret));
  command->~Command();
}

TEST(Secret, IsWipedFromATextToo) {
  std::string text(32, 's');
  wipe(text);
  EXPECT_EQ(text, std::string(32, '\0'));
}

}  // namespace
}  // namespace longreach::secret_test
