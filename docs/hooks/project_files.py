"""Pages of the site that are files of the project: the README, the changelog, scripts."""

from __future__ import annotations

import posixpath
import re
from pathlib import Path, PurePosixPath

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = {"README.md": "index.md", "CHANGELOG.md": "changelog.md"}
LANGUAGES = {".py": "python", ".c": "c", ".toml": "toml"}
LINK = re.compile(r"\]\((?P<target>[^)#\s]+)(?P<anchor>#[^)\s]*)?\)")


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the documents above the folder of pages, and every script that a page links to."""
    for source, page in DOCUMENTS.items():
        text = (ROOT / source).read_text(encoding="utf-8")
        files.append(File.generated(config, page, content=_relinked(text, source, page)))
    for path in sorted(_linked_scripts(files)):
        code = (ROOT / path).read_text(encoding="utf-8").rstrip()
        content = f"# `{path}`\n\n```` {LANGUAGES[path.suffix]}\n{code}\n````\n"
        files.append(File.generated(config, _page_of(path), content=content))
    return files


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """Lead links that leave the folder of pages to the pages made of these files."""
    path = page.file.src_uri
    return markdown if page.file.generated_by else _relinked(markdown, f"docs/{path}", path)


def _page_of(path: PurePosixPath) -> str:
    return f"files/{path}.md"


def _linked_scripts(files: Files) -> set[PurePosixPath]:
    """Scripts of the project that a document or a page links to."""
    texts = {source: (ROOT / source).read_text(encoding="utf-8") for source in DOCUMENTS}
    texts |= {
        f"docs/{file.src_uri}": file.content_string
        for file in files.documentation_pages()
        if not file.generated_by
    }
    return {
        path
        for source, text in texts.items()
        for link in LINK.finditer(text)
        if (path := _target(source, link["target"])).suffix in LANGUAGES and (ROOT / path).is_file()
    }


def _target(source: str, target: str) -> PurePosixPath:
    """Path in the project of what `source`, a path in the project, links to."""
    return PurePosixPath(posixpath.normpath(posixpath.join(posixpath.dirname(source), target)))


def _relinked(text: str, source: str, page: str) -> str:
    """Lead the links of a text from files of the project to their pages, as seen from `page`."""

    def relink(link: re.Match[str]) -> str:
        if "://" in link["target"]:
            return link[0]
        path = _target(source, link["target"])
        if str(path) in DOCUMENTS:
            place = DOCUMENTS[str(path)]
        elif path.suffix in LANGUAGES and (ROOT / path).is_file():
            place = _page_of(path)
        elif path.parts[0] == "docs":
            place = str(path.relative_to("docs"))
        else:
            return link[0]  # left for the check of links to find
        relative = posixpath.relpath(place, posixpath.dirname(page) or ".")
        return f"]({relative}{link['anchor'] or ''})"

    return LINK.sub(relink, text)
