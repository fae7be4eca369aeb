/* The bundle's files, as they are. */
.section .rodata
.macro embed name, file
.global longreach_\name\()_begin
.global longreach_\name\()_end
longreach_\name\()_begin:
.incbin "\file"
longreach_\name\()_end:
.byte 0
.endm
embed page_html, "index.html"
embed page_script, "view.js"
embed page_style, "view.css"
.section .note.GNU-stack, "", %progbits
