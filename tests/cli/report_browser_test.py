#!/usr/bin/env python3
"""A report in a real browser: nothing is asked for, nothing goes wrong, figures show, tables sort and filter by keyboard,
and on a telephone nothing sticks out.

Usage: report_browser_test.py RIDGELOC BROWSER [FOLDER]    (FOLDER: keeps the report and pictures of it there)
"""

import contextlib
import pathlib
import subprocess
import sys
import tempfile

from browser import Browser

STUDY = """title = "A <b>small</b> study"
aims = "Does the page work?"
experiment = "ranging"
trials = 200
[sweep]
points = [3, 4, 5, 7]
range_sigma_m = [0.1, 0.3, 0.5]
[[method]]
solver = "rrr"
[[method]]
name = "lm, 'quoted' & <marked>"
solver = "lm"
[[figure]]
x = "points"
y = "error_all_m"
group = "range_sigma_m"
facet = "method"
[[figure]]
name = "rate"
x = "points"
y = "converged"
group = ["range_sigma_m", "method"]
"""

# A table: the column of its first method as numbers, from top to bottom, and how many rows it shows.
TABLE = """document.querySelector("#r1-measure2 table")"""
COLUMN = f"""Array.from({TABLE}.tBodies[0].rows, (row) => Number(row.cells[2].dataset.key))"""
SHOWN = f"""Array.from({TABLE}.tBodies[0].rows).filter((row) => !row.hidden).length"""
TAB, ENTER, SPACE = ("Tab", 9), ("Enter", 13, "\r"), (" ", 32, " ")


def check(condition, what):
    if not condition:
        raise SystemExit(f"report_browser_test: {what}")


def check_quiet(browser, url):
    check(browser.complaints() == [], f"the console says {browser.complaints()}")
    check(browser.requests() == [url], f"the page asks for {browser.requests()[1:]}")


def check_figures(browser):
    """Each of them has a size and shows its marks, which are references within the figure."""
    figures = browser.value("""Array.from(document.querySelectorAll("figure svg"), (figure) => {
        const visible = (part) => part.getBoundingClientRect().width > 0 && part.getBoundingClientRect().height > 0;
        const box = figure.getBoundingClientRect();
        return [box.width, box.height, Array.from(figure.querySelectorAll("use")).filter(visible).length];
    })""")
    check(len(figures) == 4, f"{len(figures)} figures instead of 4")
    points = 4 * 3 * 2
    check(all(width > 250 and height > 250 and marks >= points for width, height, marks in figures),
          f"width, height and visible marks of the figures are {figures}")


def check_sorting(browser):
    """Sorts a table by its third column with Enter and back with the space bar."""
    before = browser.value(COLUMN)
    check(before != sorted(before), "the table is sorted before anyone has asked for it")
    browser.value(f"""{TABLE}.querySelectorAll("th button")[1].focus()""")
    browser.press(*TAB)
    focused = browser.value("document.activeElement.textContent")
    check(focused == "rrr", f"Tab goes to {focused!r}")
    state = """document.activeElement.closest("th").getAttribute("aria-sort")"""
    browser.press(*ENTER)
    check(browser.value(COLUMN) == sorted(before), "Enter does not sort")
    check(browser.value(state) == "ascending", "aria-sort is not ascending")
    browser.press(*SPACE)
    check(browser.value(COLUMN) == sorted(before, reverse=True), "the space bar does not sort the other way")
    check(browser.value(state) == "descending", "aria-sort is not descending")


def check_filter(browser):
    browser.value("""document.querySelector("#r1-measure2 .filter input").focus()""")
    for letter in "0.5":
        browser.press(letter, ord(letter), letter)
    check(0 < browser.value(SHOWN) < 12, f"the filter leaves {browser.value(SHOWN)} of 12 rows")


def check_width(browser, width):
    """With everything unfolded, too."""
    for unfold in (False, True):
        if unfold:
            browser.value("document.querySelectorAll('details').forEach((part) => { part.open = true; })")
        needed = browser.value("document.documentElement.scrollWidth")
        check(needed <= width, f"the page is {needed} wide on a screen of {width}")


def check_text(browser):
    """Text of the study is text, and the headings have no gaps in their order."""
    check(browser.value("document.querySelectorAll('b:not(.flag, .best), marked').length") == 0, "a title became HTML")
    check(browser.value("document.title") == "2 studies", "the title is wrong")
    levels = browser.value("Array.from(document.querySelectorAll('h1, h2, h3, h4'), (h) => Number(h.tagName[1]))")
    check(levels[0] == 1 and all(b <= a + 1 for a, b in zip(levels, levels[1:])), f"headings go {levels}")


def check_report(program, browser_program, folder):
    (folder / "small.toml").write_text(STUDY)
    for arguments in (["run", "small.toml"], ["report", "small.h5", "small.h5", "-o", "report.html"]):
        subprocess.run([program, *arguments], cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    url = (folder / "report.html").as_uri()
    with contextlib.closing(Browser(browser_program)) as browser:
        for width, height in ((1280, 900), (360, 740)):
            for dark in (False, True):
                browser.show_as(width, height, dark)
                browser.open(url)
                browser.save_picture(folder / f"report-{width}-{'dark' if dark else 'light'}.png", whole_page=True)
                check_figures(browser)
                check_width(browser, width)
                check_quiet(browser, url)
        browser.show_as(1280, 900)
        browser.open(url)
        check_text(browser)
        check_sorting(browser)
        check_filter(browser)
        check_quiet(browser, url)
        browser.call("Emulation.setScriptExecutionDisabled", value=True)
        browser.open(url)
        check(browser.value("document.querySelectorAll('button, input').length") == 0, "controls without their script")
        check_figures(browser)


if __name__ == "__main__":
    if len(sys.argv) > 3:
        check_report(sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]).resolve())
    else:
        with tempfile.TemporaryDirectory(dir=".") as scratch:
            check_report(sys.argv[1], sys.argv[2], pathlib.Path(scratch).resolve())
    print("the report works in a browser")
