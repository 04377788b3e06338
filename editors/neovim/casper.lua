-- For Neovim 0.8 or newer: put this into init.lua, or into a file in ~/.config/nvim/after/plugin.
-- It starts `casper lsp` for the texts of a domain; take the casper of your virtual environment where it is not on the path.
local files = { "ontology.pl", "plans.pl", "actions.pl", "movements.pl", "scene.pl", "words.pl", "tests.pl" }

vim.api.nvim_create_autocmd({ "BufReadPost", "BufNewFile" }, {
  pattern = files,
  callback = function(event)
    vim.bo[event.buf].filetype = "prolog" -- for the colours
    vim.bo[event.buf].commentstring = "%% %s"
    vim.lsp.start({
      name = "casper",
      cmd = { "casper", "lsp" },
      root_dir = vim.fs.dirname(vim.api.nvim_buf_get_name(event.buf)),
    })
  end,
})
