"""From data to YAML text: a new text, an existing text with some values changed, or a text in the house style.

`writer` makes new texts of `scalars`; `patch` changes values of a text by `entry_edits`; `house_style` puts a text in
order by `layout`, `inline_layout` and `leaves`; `modeline` removes an editor's comment.
"""
