#!/usr/bin/env bash
# Builds the documentation's site into build/site. Needs mkdocs with the material theme (Debian package
# mkdocs-material). A page that is missing, or a link that leads nowhere, fails the build.
#   tools/docs/build_site.sh
set -euo pipefail
cd "$(dirname "$0")/../.."

# Copy the pages, the images and the files that pages link to into one folder, as mkdocs requires.
pages=build/site_pages
rm -rf "$pages"
mkdir -p "$pages"
cp --parents README.md CONTRIBUTING.md CHANGELOG.md LICENSE deploy/*.md "$pages"
find docs -name '*.md' -o -name '*.png' -o -name '*.jpg' -o -name '*.webp' -o -name '*.svg' | xargs cp --parents -t "$pages"
grep -rhoE '\]\(\.\./[^)#]+' docs | sed 's|^](\.\./||' | sort -u | while read -r linked; do
  if [ -f "$linked" ]; then cp --parents "$linked" "$pages"; fi
done

mkdocs build --strict --quiet || mkdocs build --strict  # if it fails, run it again with its messages
echo "build/site/index.html"
