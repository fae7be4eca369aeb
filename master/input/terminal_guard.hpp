#pragma once
// Restores the terminal at the end of the program: line mode, echo, cursor and screen. The saved state is
// restored by the functions below, at exit, and by signals that end the program, which then have their
// default effect. Signals for which the program has its own handler are not affected. A stalled terminal
// delays the end of the program by at most 0.2 s; its unread output is discarded. Only one terminal per
// program is supported. Not thread-safe.

struct termios;

namespace longreach {

/// Opens the terminal of `fd` a second time in non-blocking mode, because `fd` is shared with the shell, so
/// its mode must not change. The caller closes the returned descriptor.
int open_anew(int fd);

/// Returns whether the terminal `fd` currently belongs to another program. Reading or changing it would then
/// stop this program (SIGTTIN, SIGTTOU).
bool in_background(int fd);

/// Saves `mode`, the current mode of `fd`. Call this before changing the mode.
void keep_terminal_mode(int fd, const termios& mode);
/// Restores the saved mode, if there is one.
void give_back_terminal_mode();

/// Records that `fd` is about to show the alternate screen without a cursor.
void keep_screen(int fd);
/// Restores the normal screen and the cursor, if they were changed.
void give_back_screen();

}  // namespace longreach
