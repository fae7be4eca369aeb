#pragma once
// Gives the terminal back as it was, however the program ends: line mode, echo, cursor and screen. What is
// kept here is given back by the calls below, at exit, and by signals that end the program; those then take
// their course. A signal for which the program has its own answer is left to it. A terminal that nobody reads
// delays the end by 0.2 s at most; what lies there unread goes. One terminal a program. Not for several
// threads.

struct termios;

namespace longreach {

/// `fd` anew, as one that never waits: `fd` itself may not be made so, for the shell has it, too. The
/// caller's to close.
int open_anew(int fd);

/// The terminal `fd` belongs to another program now: to read or to change it would stop this one (SIGTTIN,
/// SIGTTOU).
bool in_background(int fd);

/// Remembers `mode`, the present one of `fd`, before it is changed.
void keep_terminal_mode(int fd, const termios& mode);
void give_back_terminal_mode();

/// Remembers that `fd` is about to show the other screen without a cursor.
void keep_screen(int fd);
void give_back_screen();

}  // namespace longreach
