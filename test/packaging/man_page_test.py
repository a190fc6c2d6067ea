"""Man pages, which are made of what the programs say with --help."""
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "cmake"))
import man_page  # noqa: E402

HELP = """plot FILE [--output PICTURE]
     [--show WHAT]
plot --help
Draws a motion.
.ci and 'quoted' and a\\b stay.

Options:
  -h [ --help ]   prints this
Exit code: 0.
"""


def test_sections_come_from_the_help():
    page = man_page.page("plot", HELP)
    sections = [line[4:] for line in page.split("\n") if line.startswith(".SH ")]
    assert sections == ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "SEE ALSO"]
    assert "plot \\- pictures of a motion" in page
    synopsis = page[page.index("SYNOPSIS"):page.index("DESCRIPTION")]
    assert "[\\-\\-show WHAT]" in synopsis and "plot \\-\\-help" in synopsis and "Draws" not in synopsis
    assert "\\-h [ \\-\\-help ]" in page[page.index("OPTIONS"):]


def test_what_troff_would_obey_is_text():
    page = man_page.page("plot", HELP)
    assert "\n\\&.ci and 'quoted' and a\\eb stay.\n" in page
    requests = {line.split(" ")[0] for line in page.split("\n") if line[:1] in (".", "'")}
    assert requests == {".TH", ".SH", ".nf", ".fi"}


def test_a_page_is_made_of_a_program(tmp_path):
    program = tmp_path / "plot"
    program.write_text("#!/bin/sh\n[ \"$1\" = --help ] && echo 'plot FILE' && echo 'Says it.'\n")
    program.chmod(0o755)
    page = subprocess.run([sys.executable, man_page.__file__, str(program)], stdout=subprocess.PIPE, text=True, check=True).stdout
    assert "\nSays it.\n" in page
