#!/usr/bin/env bash
# Builds the documentation's site into build/site. Needs mkdocs with the material theme (Debian package mkdocs-material).
# A page that is missing, or a link that leads nowhere, fails the build.
#   tools/docs/build_site.sh
set -euo pipefail
cd "$(dirname "$0")/../.."

# mkdocs wants its pages in a folder of their own: the tree's pages, pictures, and files that pages link to.
pages=build/site_pages
rm -rf "$pages"
mkdir -p "$pages"
cp --parents README.md CONTRIBUTING.md CHANGELOG.md LICENSE deploy/*.md "$pages"
find docs -name '*.md' -o -name '*.png' -o -name '*.jpg' -o -name '*.webp' -o -name '*.svg' | xargs cp --parents -t "$pages"
grep -rhoE '\]\(\.\./[^)#]+' docs | sed 's|^](\.\./||' | sort -u | while read -r linked; do
  if [ -f "$linked" ]; then cp --parents "$linked" "$pages"; fi
done

mkdocs build --strict --quiet || mkdocs build --strict  # the second one says what is wrong
echo "build/site/index.html"
