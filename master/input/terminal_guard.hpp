#pragma once
// Restores the terminal at the end of the program: line mode, echo, cursor and screen. The saved state is
// restored by the calls below, at exit, and by signals that end the program; these then take their course.
// Signals with a handler of the program are not affected. A stalled terminal delays the end by at most 0.2 s;
// its unread output is discarded. One terminal per program. Not thread-safe.

struct termios;

namespace longreach {

/// Opens the terminal of `fd` again in non-blocking mode: `fd` itself may not be changed, because the shell
/// shares it. The caller closes it.
int open_anew(int fd);

/// Returns whether the terminal `fd` now belongs to another program: reading or changing it would stop this
/// program (SIGTTIN, SIGTTOU).
bool in_background(int fd);

/// Saves `mode`, the present mode of `fd`, before it is changed.
void keep_terminal_mode(int fd, const termios& mode);
void give_back_terminal_mode();

/// Notes that `fd` is about to show the alternate screen without a cursor.
void keep_screen(int fd);
void give_back_screen();

}  // namespace longreach
