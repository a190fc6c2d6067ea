"""The pages of docs/: every page is in the index, and every link and named file is there."""
import re
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted((ROOT / "docs").glob("*.md")) + [ROOT / "README.md"]


def test_every_page_is_in_the_index():
    index = (ROOT / "docs" / "README.md").read_text()
    missing = [page.name for page in PAGES if page.parent.name == "docs" and page.name != "README.md" and f"({page.name})" not in index]
    assert missing == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    links = re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", page.read_text())
    assert [link for link in links if not link.startswith("http") and not (page.parent / link).exists()] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_files_that_are_named_are_there(page):
    named = re.findall(r"`((?:docs|config|launch|scripts)/[\w./-]+\.(?:md|yaml|launch|urdf|rviz|rules))`", page.read_text())
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_moveit_and_the_aggregator_have_the_joints_and_names_of_the_example():
    joints = yaml.safe_load((ROOT / "config/six_axis_epos.yaml").read_text())["joints"]
    (controller,) = yaml.safe_load((ROOT / "config/moveit/controllers.yaml").read_text())["controller_list"]
    assert (controller["name"], controller["joints"]) == ("driver", joints)
    aggregator = yaml.safe_load((ROOT / "config/diagnostics/aggregator.yaml").read_text())
    analyzers = aggregator["analyzers"]["motion"]["analyzers"].values()
    prefixes = [text for analyzer in analyzers for text in analyzer.get("startswith", []) + analyzer.get("name", [])]
    published = ["driver: " + name for name in re.findall(r'updater_\.add\("([^"]+)"', (ROOT / "src/node/diagnostics.cpp").read_text())]
    assert sorted(prefixes) == sorted(published)
